#pragma once

#include <vector>

#include <Eigen/Core>

namespace myoid::inline ground::math {

/// Covariance and identifiability of parameters by the Jacobian at the minimum. J = dr/dx is n x p.
struct CovarianceResult {
  int rank = 0;
  Eigen::MatrixXd unscaled;        ///< (J'J)^+ over the determined directions only; p x p.
  double residual_variance = 0.0;  ///< s^2 = |r|^2 / (n - rank); 0 when n == rank.
  Eigen::MatrixXd undetermined;    ///< p x (p - rank), unit columns: combinations that the data do not determine.
  std::vector<bool> determined;    ///< For each parameter: it has no part above 1e-6 in an undetermined direction.
};

/// Computes these from the SVD of J with columns scaled to unit length; singular values below `rank_tolerance` of the
/// largest are zero. J'J, which would square the condition, serves only to complete the undetermined directions of a J
/// with fewer rows than columns. Throws InvalidInput if J or r is not finite or their rows disagree.
[[nodiscard]] CovarianceResult covariance(const Eigen::MatrixXd& jacobian,
                                          const Eigen::VectorXd& residual,
                                          double rank_tolerance = 1e-8);

}  // namespace myoid::inline ground::math
