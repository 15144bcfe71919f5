#include "myoid/posterior/importance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <Eigen/Cholesky>

#include "myoid/core/parallel.h"
#include "myoid/math/random.h"

namespace myoid::identification {
namespace {

constexpr double kTrusted = 0.7;
constexpr double kFreedom = 20.0;  // of Student's t

std::vector<Eigen::Index> order_of(const Eigen::VectorXd& values) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return values[a] < values[b]; });
  return order;
}

/// Chi-squared over its degrees of freedom, which are even.
double mean_square(math::Random& random) {
  double sum = 0.0;
  for (int i = 0; i < static_cast<int>(kFreedom) / 2; ++i)
    sum -= 2.0 * std::log(1.0 - random.uniform());
  return sum / kFreedom;
}

Draws propose(const std::function<double(const Eigen::VectorXd&)>& log_density,
              const Eigen::VectorXd& mean,
              const Eigen::MatrixXd& covariance,
              Eigen::Index count,
              std::uint64_t seed) {
  const Eigen::Index d = mean.size();
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  Draws draws;
  draws.x.resize(d, count);
  Eigen::VectorXd log_ratio(count);
  parallel_ranges(count, Eigen::Index{1}, [&](const auto& range) {
    for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
      math::Random random(seed, static_cast<std::uint64_t>(i));
      Eigen::VectorXd normal(d);
      for (double& v : normal) v = random.normal();
      normal /= std::sqrt(mean_square(random));
      draws.x.col(i) = mean + root * normal;
      const double log_proposal =
          -0.5 * (kFreedom + static_cast<double>(d)) * std::log1p(normal.squaredNorm() / kFreedom);
      log_ratio[i] = log_density(draws.x.col(i)) - log_proposal;
    }
  });
  const SmoothedWeights smoothed = smooth_weights(log_ratio);
  draws.weight = smoothed.weight;
  draws.khat = smoothed.khat;
  return draws;
}

}  // namespace

double ParetoFit::quantile(double share) const {
  if (std::abs(shape) < 1e-12) return -scale * std::log1p(-share);
  return scale * std::expm1(-shape * std::log1p(-share)) / shape;
}

ParetoFit fit_pareto(const Eigen::VectorXd& exceedances) {
  const Eigen::Index n = exceedances.size();
  const auto count = static_cast<double>(n);
  const auto grid = static_cast<Eigen::Index>(30.0 + std::floor(std::sqrt(count)));
  const double quartile =
      exceedances[std::max<Eigen::Index>(0, static_cast<Eigen::Index>(count / 4.0 + 0.5) - 1)];
  Eigen::VectorXd theta(grid), log_profile(grid);
  for (Eigen::Index j = 0; j < grid; ++j) {
    theta[j] = 1.0 / exceedances[n - 1] +
               (1.0 - std::sqrt(static_cast<double>(grid) / (static_cast<double>(j) + 0.5))) /
                   (3.0 * quartile);
    const double k = (-theta[j] * exceedances.array()).log1p().mean();
    log_profile[j] = count * (std::log(-theta[j] / k) - k - 1.0);
  }
  const Eigen::ArrayXd weight = (log_profile.array() - log_profile.maxCoeff()).exp();
  const double best = (weight * theta.array()).sum() / weight.sum();
  const double k = (-best * exceedances.array()).log1p().mean();
  return {.shape = (k * count + 0.5 * 10.0) / (count + 10.0), .scale = -k / best};
}

SmoothedWeights smooth_weights(const Eigen::VectorXd& log_ratio) {
  const Eigen::Index n = log_ratio.size();
  Eigen::VectorXd log_weight = log_ratio;
  SmoothedWeights result;
  const double most = log_ratio.maxCoeff();
  if (!std::isfinite(most)) {
    result.weight = Eigen::VectorXd::Constant(n, 1.0 / static_cast<double>(n));
    result.khat = std::numeric_limits<double>::infinity();
    return result;
  }
  log_weight.array() -= most;
  const auto tail = static_cast<Eigen::Index>(
      std::min(0.2 * static_cast<double>(n), 3.0 * std::sqrt(static_cast<double>(n))));
  result.khat = std::numeric_limits<double>::infinity();
  if (tail >= 5) {
    const std::vector<Eigen::Index> order = order_of(log_weight);
    const auto from = static_cast<std::size_t>(n - tail);
    const double below = std::exp(log_weight[order[from - 1]]);
    Eigen::VectorXd exceedances(tail);
    for (Eigen::Index i = 0; i < tail; ++i)
      exceedances[i] = std::exp(log_weight[order[from + static_cast<std::size_t>(i)]]) - below;
    if (exceedances[0] > 0.0) {
      const ParetoFit fit = fit_pareto(exceedances);
      result.khat = fit.shape;
      for (Eigen::Index i = 0; i < tail; ++i) {
        const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(tail);
        log_weight[order[from + static_cast<std::size_t>(i)]] =
            std::min(0.0, std::log(below + fit.quantile(share)));
      }
    } else if (exceedances[tail - 1] == 0.0) {
      result.khat = -std::numeric_limits<double>::infinity();  // all alike
    }
  }
  result.weight = (log_weight.array() - log_weight.maxCoeff()).exp();
  result.weight /= result.weight.sum();
  return result;
}

Draws draw(const std::function<double(const Eigen::VectorXd&)>& log_density,
           const Eigen::VectorXd& mean,
           const Eigen::MatrixXd& covariance,
           Eigen::Index count,
           std::uint64_t seed) {
  Draws draws = propose(log_density, mean, covariance, count, seed);
  if (draws.khat < kTrusted) return draws;
  // As many effective draws as unknowns bear a mean and the spread along each axis.
  const Eigen::VectorXd center = draws.x * draws.weight;
  const Eigen::VectorXd spread = ((draws.x.colwise() - center).cwiseAbs2() * draws.weight)
                                     .cwiseQuotient(covariance.diagonal())
                                     .cwiseMax(0.5)
                                     .cwiseMin(4.0)
                                     .cwiseSqrt();
  const Draws again = propose(
      log_density, center, spread.asDiagonal() * covariance * spread.asDiagonal(), count, seed + 1);
  if (again.khat < kTrusted) return again;
  const double khat = std::min(draws.khat, again.khat);
  draws = draw_normal(mean, covariance, count, seed);
  draws.approximate = true;
  draws.khat = khat;
  return draws;
}

Draws draw_normal(const Eigen::VectorXd& mean,
                  const Eigen::MatrixXd& covariance,
                  Eigen::Index count,
                  std::uint64_t seed) {
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  Draws draws;
  draws.x.resize(mean.size(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    math::Random random(seed, static_cast<std::uint64_t>(i));
    Eigen::VectorXd normal(mean.size());
    for (double& v : normal) v = random.normal();
    draws.x.col(i) = mean + root * normal;
  }
  draws.weight = Eigen::VectorXd::Constant(count, 1.0 / static_cast<double>(count));
  return draws;
}

double weighted_quantile(const Eigen::VectorXd& values,
                         const Eigen::VectorXd& weight,
                         double share) {
  const std::vector<Eigen::Index> order = order_of(values);
  double before = 0.0, last = values[order.front()], place = 0.0;
  for (const Eigen::Index i : order) {
    const double middle = before + 0.5 * weight[i];
    if (middle >= share) {
      const double step = middle - place;
      return step > 0.0 ? last + (values[i] - last) * std::clamp((share - place) / step, 0.0, 1.0)
                        : values[i];
    }
    before += weight[i];
    place = middle;
    last = values[i];
  }
  return last;
}

}  // namespace myoid::identification
