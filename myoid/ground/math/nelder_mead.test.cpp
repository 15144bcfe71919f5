#include "myoid/ground/math/nelder_mead.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

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
    const DirectSearchResult result = nelder_mead(rosenbrock, start);
    EXPECT_EQ(result.termination, Termination::converged);
    // The other minimum in five dimensions, near x_1 = -1, costs 3.93.
    EXPECT_LT((result.x - Eigen::VectorXd::Ones(n)).norm(), 1e-6) << n;
  }
}

TEST(NelderMead, FindsNistsCertifiedMinimaWithoutDerivatives) {
  // The cost is flat to round-off (1e-16) within 1e-8 of a minimum: 5 digits are asked.
  for (const char* name : {"Misra1a", "DanWood", "BoxBOD", "Rat42", "Rat43", "MGH09", "Eckerle4"}) {
    const test::NistProblem nist = test::read_nist(name);
    const DirectSearchResult result = nelder_mead(cost_of(test::least_squares(nist)), nist.starts[1]);
    EXPECT_EQ(result.termination, Termination::converged) << name;
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
  const DirectSearchResult result = nelder_mead(mckinnon, Eigen::Vector2d(1.0, 1.0));
  EXPECT_NEAR(result.x[0], 0.0, 1e-7);
  EXPECT_NEAR(result.x[1], -0.5, 1e-7);
}

TEST(NelderMead, TakesNotANumberForAWall) {
  // sqrt(x) and log(y) are not defined left of zero; minimum (0.25, 1): x - sqrt(x), y - log y.
  const DirectSearchResult result =
      nelder_mead([](const Eigen::VectorXd& x) { return x[0] - std::sqrt(x[0]) + x[1] - std::log(x[1]); },
                  Eigen::Vector2d(4.0, 5.0));
  EXPECT_NEAR(result.x[0], 0.25, 1e-6);
  EXPECT_NEAR(result.x[1], 1.0, 1e-6);
}

TEST(NelderMead, CountsEveryEvaluationAndStopsAtTheLimit) {
  int calls = 0;
  const CostFunction counted = [&](const Eigen::VectorXd& x) {
    ++calls;
    return rosenbrock(x);
  };
  const DirectSearchResult full = nelder_mead(counted, Eigen::Vector2d(-1.2, 1.0));
  EXPECT_EQ(full.evaluations, calls);
  calls = 0;
  const DirectSearchResult cut = nelder_mead(counted, Eigen::Vector2d(-1.2, 1.0), 50);
  EXPECT_EQ(cut.termination, Termination::iteration_limit);
  EXPECT_EQ(cut.evaluations, calls);
  EXPECT_LE(calls, 53);  // the last move may need three evaluations: reflect, contract, shrink one
  EXPECT_LT(cut.cost, 24.2);
}

TEST(NelderMead, AParameterAloneIsFound) {
  const DirectSearchResult one =
      nelder_mead([](const Eigen::VectorXd& x) { return x.squaredNorm(); }, Eigen::VectorXd::Constant(1, 7.0));
  EXPECT_NEAR(one.x[0], 0.0, 1e-7);
}

}  // namespace
}  // namespace myoid::inline ground::math
