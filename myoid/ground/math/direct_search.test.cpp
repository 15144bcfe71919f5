#include "myoid/ground/math/direct_search.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/nist_problems.h"

namespace myoid::inline ground::math {
namespace {

TEST(DirectSearchProblem, OfLeastSquaresIsHalfTheSumOfSquaresWithItsBounds) {
  const test::NistProblem nist = test::read_nist("Rat42");
  LeastSquaresProblem least = test::least_squares(nist);
  least.lower = Eigen::Vector3d(1.0, 2.0, 3.0);
  const DirectSearchProblem problem = direct_search_problem(least);
  // NIST's certified residual sum of squares.
  EXPECT_NEAR(problem.cost(nist.certified), 0.5 * nist.residual_sum_of_squares, 1e-9);
  EXPECT_EQ(problem.lower, least.lower);
  EXPECT_EQ(problem.upper.size(), 0);
}

TEST(CountedCost, CountsClipsAndTakesNotANumberForInfinity) {
  const DirectSearchProblem problem{.cost = [](const Eigen::VectorXd& x) { return std::log(x[0]); },
                                    .lower = Eigen::VectorXd::Constant(1, -2.0),
                                    .upper = {}};
  CountedCost cost(problem, 1);
  EXPECT_EQ(cost(Eigen::VectorXd::Ones(1)), 0.0);
  EXPECT_EQ(cost(-Eigen::VectorXd::Ones(1)), std::numeric_limits<double>::infinity());
  EXPECT_EQ(cost(Eigen::VectorXd::Zero(1)), std::numeric_limits<double>::infinity());
  EXPECT_EQ(cost.evaluations(), 3);
  EXPECT_EQ(cost.clipped(Eigen::VectorXd::Constant(1, -5.0))[0], -2.0);
  EXPECT_EQ(cost.clipped(Eigen::VectorXd::Constant(1, 1e9))[0], 1e9);
}

TEST(CountedCost, RefusesBoundsThatAreNone) {
  const CostFunction bowl = [](const Eigen::VectorXd& x) { return x.squaredNorm(); };
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  EXPECT_THROW(CountedCost({.cost = bowl, .lower = one, .upper = -one}, 1), InvalidInput);
  EXPECT_THROW(CountedCost({.cost = bowl, .lower = one, .upper = {}}, 2), InvalidInput);
  EXPECT_THROW(CountedCost({.cost = bowl, .lower = std::nan("") * one, .upper = {}}, 1), InvalidInput);
  EXPECT_THROW(CountedCost({.cost = bowl, .lower = {}, .upper = {}}, 0), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground::math
