#include "myoid/math/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "myoid/core/error.h"
#include "myoid/core/units.h"

namespace myoid::math {

double normal_quantile(double p) {
  if (!(p > 0.0 && p < 1.0))
    throw InvalidInput("normal quantile: the probability must lie between 0 and 1");
  // Bisection on the distribution function: simple and exact to round-off.
  const auto distribution = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
  double low = -40.0;
  double high = 40.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (distribution(middle) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return values.size() % 2 == 1 ? *middle
                                : 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double effective_sample_size(const Eigen::Ref<const Eigen::VectorXd>& x,
                             const std::vector<Eigen::Index>& pieces) {
  const Eigen::Index n = x.size();
  if (n < 2) return static_cast<double>(n);
  const Eigen::VectorXd centered = x.array() - x.mean();
  const double variance = centered.squaredNorm();
  if (!(variance > 0.0)) return static_cast<double>(n);
  double sum = 0.0;
  for (Eigen::Index lag = 1; lag < n; ++lag) {
    double product = 0.0;
    Eigen::Index begin = 0;
    for (const Eigen::Index length : pieces) {
      if (lag < length)
        product +=
            centered.segment(begin, length - lag).dot(centered.segment(begin + lag, length - lag));
      begin += length;
    }
    if (product <= 0.0) break;
    sum += product / variance;
  }
  return std::max(1.0, static_cast<double>(n) / (1.0 + 2.0 * sum));
}

Eigen::MatrixXd newey_west(const Eigen::MatrixXd& scores,
                           const std::vector<Eigen::Index>& pieces,
                           Eigen::Index lag) {
  Eigen::MatrixXd sum = scores.transpose() * scores;
  for (Eigen::Index l = 1; l <= lag; ++l) {
    const double weight = 1.0 - static_cast<double>(l) / static_cast<double>(lag + 1);
    Eigen::Index begin = 0;
    for (const Eigen::Index length : pieces) {
      if (l < length) {
        const Eigen::MatrixXd g = scores.middleRows(begin + l, length - l).transpose() *
                                  scores.middleRows(begin, length - l);
        sum += weight * (g + g.transpose());
      }
      begin += length;
    }
  }
  return sum;
}

}  // namespace myoid::math
