#pragma once

#include <optional>

#include <Eigen/Core>

namespace myoid::inline ground::math {

// The decompositions of Eigen that take seconds to compile, each compiled once. Sources outside
// this room that need one of these answers call them.

/// Eigenvalues, rising, and unit eigenvectors, one a column, of a symmetric matrix.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Decomposes a symmetric matrix by tridiagonalization and the QR iteration; reads its lower triangle.
[[nodiscard]] SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

/// Computes the eigenvalues alone, rising.
[[nodiscard]] Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

/// Returns the inverse of a positive definite matrix, whose diagonal is first made larger by 1e-10 of itself.
[[nodiscard]] Eigen::MatrixXd inverse_of_positive(const Eigen::MatrixXd& matrix);

/// Returns an x that minimizes |a x - b|, by QR with column pivoting. Of dependent columns some have coefficient 0.
[[nodiscard]] Eigen::VectorXd nearest_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// Returns the shortest x that minimizes |a x - b|, by a complete orthogonal decomposition. A pivot
/// below `threshold` times the largest counts as zero; the default is round-off.
[[nodiscard]] Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& a,
                                                const Eigen::VectorXd& b,
                                                std::optional<double> threshold = std::nullopt);

/// Returns an orthonormal basis, one vector a column, of the x with a x = 0. A pivot below 1e-9 of
/// the largest counts as zero.
[[nodiscard]] Eigen::MatrixXd null_space(const Eigen::MatrixXd& a);

/// Returns the Moore-Penrose inverse, by a complete orthogonal decomposition.
[[nodiscard]] Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

/// Returns the rotation R with the greatest trace of R' m, by the singular values of m (Kabsch, 1976). With m = sum a
/// b' over pairs of centered points, R turns the b onto the a at the least squared distance.
[[nodiscard]] Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& m);

}  // namespace myoid::inline ground::math
