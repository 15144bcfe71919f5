#pragma once

#include <vector>

#include <Eigen/Core>

namespace myoid::math {

struct CovarianceOptions {
  double rank_tolerance =
      1e-8;  ///< Singular values of the column-scaled J below this share of the largest are zero.
};

/// What a Jacobian at the minimum says about the parameters. J = dr/dx is n x p.
struct CovarianceResult {
  int rank = 0;
  Eigen::VectorXd singular_values;  ///< Of J with unit columns, falling; p entries.
  double condition = 0.0;           ///< Largest over smallest of them; +inf if the smallest is 0.
  Eigen::MatrixXd unscaled;         ///< (J'J)^+ over the determined directions only; p x p.
  double residual_variance = 0.0;   ///< s^2 = |r|^2 / (n - rank); 0 when n == rank.
  Eigen::MatrixXd
      undetermined;  ///< p x (p - rank): unit columns, combinations that the data leave free.
  std::vector<bool>
      determined;  ///< Per parameter: it has no part (above 1e-6) in an undetermined direction.
};

/// From the SVD of J with columns scaled to unit length, never from J'J. Throws InvalidInput if J
/// or r is not finite or their rows disagree.
[[nodiscard]] CovarianceResult covariance(const Eigen::MatrixXd& jacobian,
                                          const Eigen::VectorXd& residual,
                                          const CovarianceOptions& options = {});

}  // namespace myoid::math
