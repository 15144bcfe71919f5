#pragma once

#include <cstdint>
#include <functional>

#include <Eigen/Core>

namespace myoid::identification {

/// Shape k and scale sigma of a generalized Pareto distribution, 1 - (1 + k x / sigma)^(-1/k).
struct ParetoFit {
  double shape = 0.0;
  double scale = 1.0;
  /// The value below which this share lies.
  [[nodiscard]] double quantile(double share) const;
};

/// From exceedances, positive and in rising order, at least 5: the estimator of Zhang and Stephens
/// (Technometrics 2009), the shape drawn to 0.5 by the weight of ten exceedances as in Vehtari et
/// al. (2024).
[[nodiscard]] ParetoFit fit_pareto(const Eigen::VectorXd& exceedances);

/// Weights that add to 1, and how heavy their tail is.
struct SmoothedWeights {
  Eigen::VectorXd weight;
  double khat = 0.0;  ///< Below 0.7 weighted means can be trusted.
  [[nodiscard]] double effective() const { return 1.0 / weight.squaredNorm(); }
};

/// Pareto-smoothed importance sampling (Vehtari, Simpson, Gelman, Yao and Gabry, JMLR 2024): of n
/// ratios, given by their logarithms, the min(n / 5, 3 sqrt n) largest are replaced by the expected
/// order statistics of the Pareto distribution that fits them, none above the largest ratio.
[[nodiscard]] SmoothedWeights smooth_weights(const Eigen::VectorXd& log_ratio);

/// Draws from a density known up to a constant.
struct Draws {
  Eigen::MatrixXd x;       ///< One column each.
  Eigen::VectorXd weight;  ///< Adds to 1.
  double khat = 0.0;
  bool approximate = false;  ///< k-hat is 0.7 or more: drawn from the normal approximation itself.
};

/// `count` draws from Student's t with `freedom` degrees of freedom about `mean` with this
/// covariance, reweighted by `log_density`. Where the weights cannot be trusted the proposal takes
/// the mean and covariance of the weighted draws, once, and it is tried again; then the answer is
/// the normal approximation, and says so. The same for every number of threads.
[[nodiscard]] Draws draw(const std::function<double(const Eigen::VectorXd&)>& log_density,
                         const Eigen::VectorXd& mean,
                         const Eigen::MatrixXd& covariance,
                         Eigen::Index count,
                         std::uint64_t seed);

/// Draws from the normal distribution itself, of equal weights, unchecked.
[[nodiscard]] Draws draw_normal(const Eigen::VectorXd& mean,
                                const Eigen::MatrixXd& covariance,
                                Eigen::Index count,
                                std::uint64_t seed);

/// The value below which this share of the weight lies, in linear interpolation.
[[nodiscard]] double weighted_quantile(const Eigen::VectorXd& values,
                                       const Eigen::VectorXd& weight,
                                       double share);

}  // namespace myoid::identification
