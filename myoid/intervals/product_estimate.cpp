#include "myoid/intervals/product_estimate.h"

#include <algorithm>
#include <cmath>

#include "myoid/math/decompositions.h"
#include "myoid/math/statistics.h"

namespace myoid::identification {
namespace {

/// Draws from a normal distribution with this covariance; every run gives the same draws.
Eigen::MatrixXd draws_about(const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance, int n) {
  const math::SymmetricEigen eigen = math::symmetric_eigen(covariance);
  const Eigen::MatrixXd root = eigen.vectors * eigen.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
  Eigen::MatrixXd result(n, mean.size());
  // Quasi-random draws: additive recurrence with square roots of primes, normal quantiles.
  const double primes[] = {2.0, 3.0, 5.0};
  for (int i = 0; i < n; ++i) {
    Eigen::VectorXd u(mean.size());
    for (Eigen::Index j = 0; j < mean.size(); ++j) {
      const double x = (i + 0.5) * std::sqrt(primes[j % 3]) + 0.37 * static_cast<double>(j);
      u[j] = math::normal_quantile(std::clamp(x - std::floor(x), 1e-6, 1.0 - 1e-6));
    }
    result.row(i) = (mean + root * u).transpose();
  }
  return result;
}

/// Standard deviation of ln x and quantiles of x.
struct Spread {
  double log_sd = 0.0;
  double low = 0.0, high = 0.0;
};

Spread spread_of(std::vector<double> logs) {
  std::sort(logs.begin(), logs.end());
  const auto at = [&](double share) {
    return logs[static_cast<std::size_t>(share * static_cast<double>(logs.size() - 1))];
  };
  // Quantiles are robust where V_ml approaches 1 and the logarithm has no lower end.
  return {(at(0.8413) - at(0.1587)) / 2.0, std::exp(at(0.025)), std::exp(at(0.975))};
}

/// Returns ln P of draws of (ln V_sh, V_ml, ln S).
std::vector<double> log_products(const Eigen::MatrixXd& draws) {
  std::vector<double> logs;
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    const double vsh = std::exp(draws(i, 0));
    const double rise = std::max(draws(i, 1) - 1.0, 0.002);
    logs.push_back(std::log(rise) + draws(i, 0) - draws(i, 2) - std::log1p(vsh));
  }
  return logs;
}

}  // namespace

void add_product_interval(ParameterEstimate& e,
                          const ProductPositions& where,
                          const std::vector<Unknown>& free,
                          const Eigen::VectorXd& z,
                          const Eigen::MatrixXd& covariance,
                          const BootstrapResult* bootstrap) {
  if (where.curvature < 0 || where.plateau < 0) return;
  const std::vector<Eigen::Index> three{where.curvature, where.plateau, where.ratio};
  constexpr int kDraws = 2000;
  const Spread posterior = spread_of(log_products(draws_about(z(three), covariance(three, three), kDraws)));
  e.std_error = e.estimate * posterior.log_sd;
  e.ci_low = posterior.low;
  e.ci_high = posterior.high;
  e.routes.push_back({"sandwich", e.ci_low, e.ci_high});
  if (bootstrap != nullptr && bootstrap->replicates.rows() >= 40) {
    const Spread boot = spread_of(log_products(bootstrap->replicates(Eigen::all, three)));
    e.routes.push_back({"bootstrap", boot.low, boot.high});
  }
  Eigen::Vector3d mean = z(three);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  bool all_priors = true;
  for (int i = 0; i < 3; ++i) {
    const Unknown& f = free[static_cast<std::size_t>(three[static_cast<std::size_t>(i)])];
    all_priors = all_priors && f.prior.sd > 0.0;
    mean[i] = f.prior.mean;
    spread(i, i) = f.prior.sd * f.prior.sd;
  }
  if (all_priors) {
    const Spread prior = spread_of(log_products(draws_about(mean, spread, kDraws)));
    e.prior_mean =
        std::exp(std::log(std::max(mean[1] - 1.0, 0.002)) + mean[0] - mean[2] - std::log1p(std::exp(mean[0])));
    e.prior_sd = *e.prior_mean * prior.log_sd;
    e.shrinkage = 1.0 - std::pow(posterior.log_sd / prior.log_sd, 2);
  }
}

}  // namespace myoid::identification
