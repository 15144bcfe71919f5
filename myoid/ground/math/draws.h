#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace myoid::inline ground::math {

/// Returns draws from the normal distribution with this mean and covariance, one column each.
[[nodiscard]] Eigen::MatrixXd draw_normal(const Eigen::VectorXd& mean,
                                          const Eigen::MatrixXd& covariance,
                                          Eigen::Index count,
                                          std::uint64_t seed);

/// Returns the value below which `share` of the weight lies, by linear interpolation.
[[nodiscard]] double weighted_quantile(const Eigen::VectorXd& values, const Eigen::VectorXd& weight, double share);

}  // namespace myoid::inline ground::math
