#pragma once

#include <array>

#include <Eigen/Core>

namespace myoid::inline ground::math {

inline constexpr std::array<double, 4> kFactorial{1.0, 1.0, 2.0, 6.0};  ///< 0! to 3!

/// The common part of natural splines of degree 2m - 1 (m = 1, 2, 3) over the same knots t_0 < .. < t_(n-1). Their m-th
/// derivative is s^(m) = sum_j c_j M_j with the B-splines M_j of degree m - 1 over t_j .. t_(j+m), of unit integral:
/// the divided difference of order m is [t_j .. t_(j+m)] s = 1/m! * integral M_j s^(m) (Peano).
struct NaturalBasis {
  int m = 3;
  Eigen::VectorXd knots;
  /// For each interval and each of its B-splines (j = i - m + 1 .. i), the polynomial of t - t_i by
  /// increasing power: column i, element (j - i + m - 1) * m + power.
  Eigen::MatrixXd pieces;
  /// Gram matrix of the B-splines over m!, by diagonals: (j, d) = A(j, j + d).
  Eigen::MatrixXd gram;
  /// Coefficients of the divided difference of order m that begins at each knot: (n - m) x (m + 1).
  Eigen::MatrixXd difference;
};

/// Builds the basis for strictly increasing knots, more than m of them.
[[nodiscard]] NaturalBasis natural_basis(const Eigen::VectorXd& knots, int m);

/// Returns the polynomial of sum_j c_j M_j on interval i, by increasing power of t - t_i.
[[nodiscard]] std::array<double, 3> highest_derivative(const NaturalBasis& basis,
                                                       const Eigen::VectorXd& c,
                                                       Eigen::Index i);

/// Factors a symmetric positive definite band matrix (by diagonals, as NaturalBasis::gram) as L D L'. Its rows are
/// scaled to a unit diagonal first, because uneven knots give rows of very different size. O(n).
class BandFactor {
 public:
  BandFactor() = default;  ///< Factors the matrix without rows.
  explicit BandFactor(Eigen::MatrixXd band);
  [[nodiscard]] Eigen::VectorXd solve(Eigen::VectorXd right) const;

 private:
  Eigen::MatrixXd factor_;  ///< (j, 0): 1 / D_j, (j, d): L(j + d, j).
  Eigen::VectorXd scale_;
};

}  // namespace myoid::inline ground::math
