#pragma once

#include <Eigen/Core>

namespace myoid::math {

/// Returns R² = 1 - sum (predicted - measured)² / sum (measured - mean)². About the mean of constant values R² is
/// undefined: the sum of the values' squares stands in its place. 1 for nothing but zeros.
[[nodiscard]] double explained_share(const Eigen::Ref<const Eigen::VectorXd>& predicted,
                                     const Eigen::Ref<const Eigen::VectorXd>& measured);

}  // namespace myoid::math
