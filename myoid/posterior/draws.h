#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace myoid::identification {

/// Weighted points that represent a distribution.
struct Draws {
  Eigen::MatrixXd x;       ///< One column per point.
  Eigen::VectorXd weight;  ///< Adds to 1.
};

/// Returns draws of equal weight from the normal distribution with this mean and covariance.
[[nodiscard]] Draws draw_normal(const Eigen::VectorXd& mean,
                                const Eigen::MatrixXd& covariance,
                                Eigen::Index count,
                                std::uint64_t seed);

/// Returns the value below which `share` of the weight lies, by linear interpolation.
[[nodiscard]] double weighted_quantile(const Eigen::VectorXd& values, const Eigen::VectorXd& weight, double share);

}  // namespace myoid::identification
