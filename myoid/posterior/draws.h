#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace myoid::identification {

/// Weighted points that stand for a distribution.
struct Draws {
  Eigen::MatrixXd x;       ///< One column each.
  Eigen::VectorXd weight;  ///< Adds to 1.
};

/// Draws from the normal distribution with this mean and covariance, of equal weights.
[[nodiscard]] Draws draw_normal(const Eigen::VectorXd& mean,
                                const Eigen::MatrixXd& covariance,
                                Eigen::Index count,
                                std::uint64_t seed);

/// The value below which this share of the weight lies, in linear interpolation.
[[nodiscard]] double weighted_quantile(const Eigen::VectorXd& values,
                                       const Eigen::VectorXd& weight,
                                       double share);

}  // namespace myoid::identification
