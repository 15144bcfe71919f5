#include "myoid/ground/math/direct_search.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/nist_problems.h"

namespace myoid::inline ground::math {
namespace {

TEST(CostOf, LeastSquaresIsHalfTheSumOfSquares) {
  const test::NistProblem nist = test::read_nist("Rat42");
  // NIST's certified residual sum of squares.
  EXPECT_NEAR(cost_of(test::least_squares(nist))(nist.certified), 0.5 * nist.residual_sum_of_squares, 1e-9);
}

TEST(CountedCost, CountsAndTakesNotANumberForInfinity) {
  const CostFunction logarithm = [](const Eigen::VectorXd& x) { return std::log(x[0]); };
  CountedCost cost(logarithm);
  EXPECT_EQ(cost(Eigen::VectorXd::Ones(1)), 0.0);
  EXPECT_EQ(cost(-Eigen::VectorXd::Ones(1)), std::numeric_limits<double>::infinity());
  EXPECT_EQ(cost(Eigen::VectorXd::Zero(1)), std::numeric_limits<double>::infinity());
  EXPECT_EQ(cost.evaluations(), 3);
  EXPECT_EQ(cost.at_start(Eigen::VectorXd::Ones(1)), 0.0);
}

TEST(CountedCost, RefusesStartsThatAreNone) {
  const CostFunction logarithm = [](const Eigen::VectorXd& x) { return std::log(x[0]); };
  CountedCost cost(logarithm);
  EXPECT_THROW((void)cost.at_start({}), InvalidInput);
  EXPECT_THROW((void)cost.at_start(Eigen::Vector2d(1.0, std::nan(""))), InvalidInput);
  EXPECT_THROW((void)cost.at_start(-Eigen::VectorXd::Ones(1)), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground::math
