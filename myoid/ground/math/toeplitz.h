#pragma once

#include <Eigen/Core>

namespace myoid::inline ground::math {

/// Returns the symmetric Toeplitz matrix with this first column.
[[nodiscard]] Eigen::MatrixXd toeplitz(const Eigen::VectorXd& first_column);

/// Returns the gradient of a function by the first column of a symmetric Toeplitz matrix; `by` is its gradient by the
/// matrix, symmetric too.
[[nodiscard]] Eigen::VectorXd by_first_column(const Eigen::Ref<const Eigen::MatrixXd>& by);

}  // namespace myoid::inline ground::math
