#include "myoid/ground/math/natural_basis.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace myoid::inline ground::math {
namespace {

Eigen::VectorXd uneven() {
  Eigen::VectorXd t(9);
  t << -1.0, -0.7, 0.1, 0.15, 0.9, 1.4, 2.6, 2.7, 3.0;
  return t;
}

// The B-splines have unit integral; summed over the intervals, polynomial by polynomial.
TEST(NaturalBasis, EveryBSplineHasUnitIntegral) {
  for (const int m : {1, 2, 3}) {
    const NaturalBasis basis = natural_basis(uneven(), m);
    const Eigen::Index count = basis.knots.size() - m;
    for (Eigen::Index j = 0; j < count; ++j) {
      double integral = 0.0;
      const Eigen::VectorXd one = Eigen::VectorXd::Unit(count, j);
      for (Eigen::Index i = 0; i + 1 < basis.knots.size(); ++i) {
        const double h = basis.knots[i + 1] - basis.knots[i];
        const auto p = highest_derivative(basis, one, i);
        integral += h * (p[0] + h * (p[1] / 2.0 + h * p[2] / 3.0));
      }
      EXPECT_NEAR(integral, 1.0, 1e-14) << m << " " << j;
    }
  }
}

// A quadratic B-spline has no jump in value or slope at the knots.
TEST(NaturalBasis, QuadraticBSplinesAreSmoothAtTheKnots) {
  const NaturalBasis basis = natural_basis(uneven(), 3);
  const Eigen::Index count = basis.knots.size() - 3;
  for (Eigen::Index j = 0; j < count; ++j) {
    const Eigen::VectorXd one = Eigen::VectorXd::Unit(count, j);
    for (Eigen::Index i = 0; i + 2 < basis.knots.size(); ++i) {
      const double h = basis.knots[i + 1] - basis.knots[i];
      const auto p = highest_derivative(basis, one, i);
      const auto next = highest_derivative(basis, one, i + 1);
      EXPECT_NEAR(p[0] + h * (p[1] + h * p[2]), next[0], 1e-12);
      EXPECT_NEAR(p[1] + 2.0 * h * p[2], next[1], 1e-11);
    }
  }
}

// [t_j .. t_(j+m)] of t^m is 1, of lower powers 0.
TEST(NaturalBasis, DividedDifferencesOfPowers) {
  for (const int m : {1, 2, 3}) {
    const NaturalBasis basis = natural_basis(uneven(), m);
    for (Eigen::Index j = 0; j < basis.difference.rows(); ++j) {
      for (int power = 0; power <= m; ++power) {
        double sum = 0.0;
        for (int k = 0; k <= m; ++k) sum += basis.difference(j, k) * std::pow(basis.knots[j + k], power);
        EXPECT_NEAR(sum, power == m ? 1.0 : 0.0, 1e-11);
      }
    }
  }
}

TEST(NaturalBasis, TheBandFactorSolvesWhatADenseFactorSolves) {
  const NaturalBasis basis = natural_basis(uneven(), 3);
  const Eigen::Index n = basis.gram.rows();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index d = 0; d < basis.gram.cols() && j + d < n; ++d)
      dense(j, j + d) = dense(j + d, j) = basis.gram(j, d);
  }
  const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
  const Eigen::VectorXd x = BandFactor(basis.gram).solve(right);
  EXPECT_LT((dense * x - right).norm(), 1e-13 * dense.norm() * x.norm());
}

}  // namespace
}  // namespace myoid::inline ground::math
