#include "myoid/ground/math/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {

double normal_quantile(double p) {
  if (!(p > 0.0 && p < 1.0)) throw InvalidInput("normal quantile: the probability must lie between 0 and 1");
  return boost::math::quantile(boost::math::normal(), p);
}

double normal_below(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

double student_quantile(double p, double freedom) {
  if (!(p > 0.0 && p < 1.0 && freedom > 0.0))
    throw InvalidInput("Student's quantile: the probability must lie between 0 and 1, the degrees of freedom above 0");
  return boost::math::quantile(boost::math::students_t(freedom), p);
}

double chi_squared_tail(double x, double freedom) {
  if (!(x >= 0.0 && freedom > 0.0))
    throw InvalidInput("chi-squared: the value must not be negative, the degrees of freedom must lie above 0");
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(freedom), x));
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return values.size() % 2 == 1 ? *middle : 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double upper_median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Eigen::VectorXd positive_autocorrelation(const Eigen::Ref<const Eigen::VectorXd>& x,
                                         const std::vector<Eigen::Index>& pieces) {
  std::vector<double> rho{1.0};
  const Eigen::VectorXd centered = x.array() - x.mean();
  const double variance = centered.squaredNorm();
  for (Eigen::Index lag = 1; variance > 0.0 && lag < x.size(); ++lag) {
    double product = 0.0;
    Eigen::Index begin = 0;
    for (const Eigen::Index length : pieces) {
      if (lag < length)
        product += centered.segment(begin, length - lag).dot(centered.segment(begin + lag, length - lag));
      begin += length;
    }
    if (product <= 0.0) break;
    rho.push_back(product / variance);
  }
  return Eigen::Map<const Eigen::VectorXd>(rho.data(), static_cast<Eigen::Index>(rho.size()));
}

double effective_sample_size(const Eigen::Ref<const Eigen::VectorXd>& x, const std::vector<Eigen::Index>& pieces) {
  const auto n = static_cast<double>(x.size());
  if (n < 2) return n;
  return std::max(1.0, n / (2.0 * positive_autocorrelation(x, pieces).sum() - 1.0));
}

Eigen::VectorXd moving_mean(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index width) {
  Eigen::VectorXd sum(x.size() + 1);
  sum[0] = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) sum[i + 1] = sum[i] + x[i];
  const Eigen::Index count = x.size() - width + 1;
  return (sum.segment(width, count) - sum.head(count)) / static_cast<double>(width);
}

double greatest_mean(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz, double window_s) {
  const auto wanted = static_cast<Eigen::Index>(std::lround(window_s * rate_hz));
  return moving_mean(x, std::clamp<Eigen::Index>(wanted, 1, x.size())).maxCoeff();
}

double explained_share(const Eigen::Ref<const Eigen::VectorXd>& predicted,
                       const Eigen::Ref<const Eigen::VectorXd>& measured) {
  const double square = measured.squaredNorm();
  const double varied = (measured.array() - measured.mean()).square().sum();
  const double total = varied > 1e-6 * square ? varied : square;
  return total > 0.0 ? 1.0 - (predicted - measured).squaredNorm() / total : 1.0;
}

std::vector<Eigen::Index> rising_order(const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return values[a] < values[b]; });
  return order;
}

}  // namespace myoid::inline ground::math
