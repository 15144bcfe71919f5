#include "myoid/ground/math/nelder_mead.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/nist_problems.h"

namespace myoid::inline ground::math {
namespace {

double rosenbrock(const Eigen::VectorXd& x) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i + 1 < x.size(); ++i)
    sum += 100.0 * std::pow(x[i + 1] - x[i] * x[i], 2) + std::pow(1.0 - x[i], 2);
  return sum;
}

TEST(NelderMead, DescendsRosenbrocksValleyInTwoAndFiveDimensions) {
  for (const Eigen::Index n : {2, 5}) {
    const Eigen::VectorXd start = Eigen::VectorXd::Constant(n, -0.3);
    const DirectSearchResult result = nelder_mead({.cost = rosenbrock, .lower = {}, .upper = {}}, start);
    EXPECT_EQ(result.termination, Termination::converged) << result.message;
    // The other minimum in five dimensions, near x_1 = -1, costs 3.93.
    EXPECT_LT((result.x - Eigen::VectorXd::Ones(n)).norm(), 1e-6) << n;
  }
}

TEST(NelderMead, FindsNistsCertifiedMinimaWithoutDerivatives) {
  // The cost is flat to round-off (1e-16) within 1e-8 of a minimum: 5 digits are asked.
  for (const char* name : {"Misra1a", "DanWood", "BoxBOD", "Rat42", "Rat43", "MGH09", "Eckerle4"}) {
    const test::NistProblem nist = test::read_nist(name);
    const DirectSearchResult result = nelder_mead(direct_search_problem(test::least_squares(nist)), nist.starts[1]);
    EXPECT_EQ(result.termination, Termination::converged) << name << ": " << result.message;
    EXPECT_NEAR(2.0 * result.cost / nist.residual_sum_of_squares, 1.0, 1e-9) << name;
    for (Eigen::Index j = 0; j < result.x.size(); ++j)
      EXPECT_NEAR(result.x[j] / nist.certified[j], 1.0, 1e-5) << name << " b" << j + 1;
  }
}

TEST(NelderMead, ARestartLeavesThePointWhereMcKinnonsSimplexShrinks) {
  // McKinnon 1998 (tau = 2, theta = 6, phi = 60): minimum -0.25 at (0, -0.5). From the vertices
  // (0,0), (1,1), (0.84, -0.59) the simplex contracts for ever onto the origin, no stationary
  // point. The search must end at the minimum, whatever its first simplex does.
  const auto mckinnon = [](const Eigen::VectorXd& x) {
    return (x[0] <= 0.0 ? 360.0 : 6.0) * x[0] * x[0] + x[1] + x[1] * x[1];
  };
  const DirectSearchResult result =
      nelder_mead({.cost = mckinnon, .lower = {}, .upper = {}}, Eigen::Vector2d(1.0, 1.0));
  EXPECT_NEAR(result.x[0], 0.0, 1e-7);
  EXPECT_NEAR(result.x[1], -0.5, 1e-7);
}

TEST(NelderMead, StaysWithinBoundsAndFindsTheMinimumOnAFace) {
  // (x - 3)^2 + (y - x)^2 + (z + 1)^2 with x <= 2, z >= 0: minimum (2, 2, 0), cost 2.
  const Eigen::Vector3d lower(-5.0, -5.0, 0.0), upper(2.0, 5.0, 4.0);
  bool left = false;
  const DirectSearchResult result =
      nelder_mead({.cost =
                       [&](const Eigen::VectorXd& x) {
                         left = left || (x.array() < lower.array()).any() || (x.array() > upper.array()).any();
                         return std::pow(x[0] - 3.0, 2) + std::pow(x[1] - x[0], 2) + std::pow(x[2] + 1.0, 2);
                       },
                   .lower = lower,
                   .upper = upper},
                  Eigen::Vector3d(-4.0, 4.0, 3.0));
  EXPECT_FALSE(left);
  EXPECT_EQ(result.termination, Termination::converged) << result.message;
  EXPECT_EQ(result.x[0], 2.0);
  EXPECT_EQ(result.x[2], 0.0);
  EXPECT_NEAR(result.x[1], 2.0, 1e-7);
}

TEST(NelderMead, TakesNotANumberForAWall) {
  // sqrt(x) and log(y) are not defined left of zero; minimum (0.25, 1): x - sqrt(x), y - log y.
  const DirectSearchResult result =
      nelder_mead({.cost = [](const Eigen::VectorXd& x) { return x[0] - std::sqrt(x[0]) + x[1] - std::log(x[1]); },
                   .lower = {},
                   .upper = {}},
                  Eigen::Vector2d(4.0, 5.0), {.first_edge = 2.0});
  EXPECT_NEAR(result.x[0], 0.25, 1e-6);
  EXPECT_NEAR(result.x[1], 1.0, 1e-6);
}

TEST(NelderMead, CountsEveryEvaluationAndStopsAtTheLimit) {
  int calls = 0;
  const DirectSearchProblem problem{.cost =
                                        [&](const Eigen::VectorXd& x) {
                                          ++calls;
                                          return rosenbrock(x);
                                        },
                                    .lower = {},
                                    .upper = {}};
  const DirectSearchResult full = nelder_mead(problem, Eigen::Vector2d(-1.2, 1.0));
  EXPECT_EQ(full.evaluations, calls);
  calls = 0;
  const DirectSearchResult cut = nelder_mead(problem, Eigen::Vector2d(-1.2, 1.0), {.max_evaluations = 50});
  EXPECT_EQ(cut.termination, Termination::iteration_limit);
  EXPECT_EQ(cut.evaluations, calls);
  EXPECT_LE(calls, 53);  // the last move may need three evaluations: reflect, contract, shrink one
  EXPECT_LT(cut.cost, 24.2);
}

TEST(NelderMead, AParameterHeldByItsBoundsIsHeldAndOneAloneIsFound) {
  const auto bowl = [](const Eigen::VectorXd& x) { return x.squaredNorm(); };
  const DirectSearchResult held =
      nelder_mead({.cost = bowl, .lower = Eigen::Vector2d(1.0, -3.0), .upper = Eigen::Vector2d(1.0, 3.0)},
                  Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(held.x[0], 1.0);
  EXPECT_NEAR(held.x[1], 0.0, 1e-7);
  const DirectSearchResult one =
      nelder_mead({.cost = bowl, .lower = {}, .upper = {}}, Eigen::VectorXd::Constant(1, 7.0));
  EXPECT_NEAR(one.x[0], 0.0, 1e-7);
}

TEST(NelderMead, RefusesWhatItCannotStartFrom) {
  const auto bowl = [](const Eigen::VectorXd& x) { return x.squaredNorm(); };
  const DirectSearchProblem free{.cost = bowl, .lower = {}, .upper = {}};
  EXPECT_THROW((void)nelder_mead(free, Eigen::VectorXd()), InvalidInput);
  EXPECT_THROW((void)nelder_mead(free, Eigen::Vector2d(std::nan(""), 0.0)), InvalidInput);
  EXPECT_THROW((void)nelder_mead({.cost = bowl, .lower = Eigen::Vector2d(1, 1), .upper = {}}, Eigen::VectorXd::Ones(1)),
               InvalidInput);
  EXPECT_THROW((void)nelder_mead({.cost = bowl, .lower = Eigen::Vector2d(1, 1), .upper = Eigen::Vector2d(0, 2)},
                                 Eigen::Vector2d(1, 1)),
               InvalidInput);
  EXPECT_THROW(
      (void)nelder_mead({.cost = [](const Eigen::VectorXd&) { return std::nan(""); }, .lower = {}, .upper = {}},
                        Eigen::Vector2d(1, 1)),
      InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground::math
