#pragma once

#include <array>

#include <Eigen/Core>

namespace myoid::math {

inline constexpr std::array<double, 4> kFactorial{1.0, 1.0, 2.0, 6.0};  ///< 0! to 3!

/// What natural splines of degree 2m - 1 (m = 1, 2, 3) over the same knots t_0 < .. < t_(n-1) have
/// in common. Their m-th derivative is s^(m) = sum_j c_j M_j with the B-splines M_j of degree m - 1
/// over t_j .. t_(j+m), of unit integral: the divided difference of order m is
/// [t_j .. t_(j+m)] s = 1/m! * integral M_j s^(m) (Peano).
struct NaturalBasis {
  int m = 3;
  Eigen::VectorXd knots;
  /// Per interval and B-spline alive there (j = i - m + 1 .. i), its polynomial of t - t_i by
  /// rising power: column i, element (j - i + m - 1) * m + power.
  Eigen::MatrixXd pieces;
  /// Gram matrix of the B-splines over m!, by diagonals: (j, d) = A(j, j + d).
  Eigen::MatrixXd gram;
  /// Coefficients of the divided difference of order m that begins at each knot: (n - m) x (m + 1).
  Eigen::MatrixXd difference;
};

/// For strictly increasing knots, more than m of them.
[[nodiscard]] NaturalBasis natural_basis(const Eigen::VectorXd& knots, int m);

/// Polynomial of sum_j c_j M_j on interval i, by rising power of t - t_i.
[[nodiscard]] std::array<double, 3> highest_derivative(const NaturalBasis& basis,
                                                       const Eigen::VectorXd& c,
                                                       Eigen::Index i);

/// L D L' of a symmetric positive definite band matrix (by diagonals, as NaturalBasis::gram), its
/// rows scaled to a unit diagonal first: uneven knots give rows of very different size. O(n).
class BandFactor {
 public:
  BandFactor() = default;  ///< Of the matrix without rows.
  explicit BandFactor(Eigen::MatrixXd band);
  [[nodiscard]] Eigen::VectorXd solve(Eigen::VectorXd right) const;

 private:
  Eigen::MatrixXd factor_;  ///< (j, 0): 1 / D_j, (j, d): L(j + d, j).
  Eigen::VectorXd scale_;
};

}  // namespace myoid::math
