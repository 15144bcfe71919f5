#include "myoid/ground/math/simulated_annealing.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/nelder_mead.h"

#include "tests/support/nist_problems.h"

namespace myoid::inline ground::math {
namespace {

/// A smooth valley, 4 times as long as wide, whose costs reach 1e13 in a box of 2 and 6 at its lowest: the last term
/// couples every pair of the six unknowns (eigenvalues 1 and 1 + 6 * 2.5 = 16).
double valley(const Eigen::VectorXd& x) {
  const Eigen::VectorXd off = x.array() - 0.3;
  return 6.0 + 1e12 * (off.squaredNorm() + 2.5 * std::pow(off.sum(), 2));
}

Eigen::VectorXd all(Eigen::Index n, double value) { return Eigen::VectorXd::Constant(n, value); }

TEST(SimulatedAnnealing, FollowsCostsOverManyPowersOfTen) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const DirectSearchResult result = simulated_annealing(valley, all(6, -0.5), {.seed = seed, .reach = all(6, 2.0)});
    EXPECT_LT(result.cost, 6.01) << seed;
    EXPECT_LT((result.x.array() - 0.3).matrix().norm(), 1e-6) << seed;
  }
}

TEST(SimulatedAnnealing, LeavesAWellThatNoDescentLeaves) {
  // Rastrigin's function in one dimension: a well at every whole number, the lowest at 0. The simplex stays in its
  // well.
  const auto rastrigin = [](const Eigen::VectorXd& x) {
    return 10.0 + x[0] * x[0] - 10.0 * std::cos(2.0 * std::numbers::pi * x[0]);
  };
  // The well at n costs about n^2.
  EXPECT_GT(nelder_mead(rastrigin, all(1, 3.0)).cost, 8.0);
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_LT(simulated_annealing(rastrigin, all(1, 3.0), {.seed = seed, .reach = all(1, 10.0)}).cost, 1.5) << seed;
}

TEST(SimulatedAnnealing, FindsNistsBoxBod) {
  const test::NistProblem nist = test::read_nist("BoxBOD");
  const CostFunction cost = cost_of(test::least_squares(nist));
  const DirectSearchResult result =
      simulated_annealing(cost, Eigen::Vector2d(100.0, 0.75), {.reach = Eigen::Vector2d(200.0, 1.0)});
  EXPECT_EQ(result.termination, Termination::converged);
  EXPECT_NEAR(2.0 * result.cost / nist.residual_sum_of_squares, 1.0, 1e-4);
  // Polished by the simplex to the certified parameters.
  const DirectSearchResult polished = nelder_mead(cost, result.x);
  EXPECT_NEAR(polished.x[0] / nist.certified[0], 1.0, 1e-6);
  EXPECT_NEAR(polished.x[1] / nist.certified[1], 1.0, 1e-6);
}

TEST(SimulatedAnnealing, IsReproducibleBySeedAndCountsEvaluations) {
  int calls = 0;
  const CostFunction counted = [&](const Eigen::VectorXd& x) {
    ++calls;
    return valley(x);
  };
  const Eigen::VectorXd start = all(6, -0.5);
  AnnealingOptions options{.seed = 3, .reach = all(6, 2.0)};
  const DirectSearchResult a = simulated_annealing(counted, start, options);
  EXPECT_EQ(a.evaluations, calls);
  EXPECT_EQ(a.x, simulated_annealing(counted, start, options).x);
  options.max_evaluations = 300;
  const DirectSearchResult cut = simulated_annealing(counted, start, options);
  EXPECT_EQ(cut.termination, Termination::iteration_limit);
  EXPECT_EQ(cut.evaluations, 300);
  options = {.seed = 4, .reach = all(6, 2.0)};
  EXPECT_NE(a.x, simulated_annealing(counted, start, options).x);
}

TEST(SimulatedAnnealing, GoesBeyondItsReachAndTakesNotANumberForAWall) {
  // From 0 with steps of at most 1 to a lowest point 5 away; points below -2 have no cost.
  const DirectSearchResult result = simulated_annealing(
      [](const Eigen::VectorXd& x) {
        return x[1] < -2.0 ? std::nan("") : 1.0 + (x - Eigen::Vector2d(5.0, -3.0)).squaredNorm();
      },
      Eigen::Vector2d::Zero(), {.reach = Eigen::Vector2d(1.0, 1.0)});
  EXPECT_NEAR(result.x[0], 5.0, 1e-2);
  EXPECT_NEAR(result.x[1], -2.0, 1e-2);
}

TEST(SimulatedAnnealing, RefusesAReachThatIsNone) {
  EXPECT_THROW((void)simulated_annealing(valley, all(6, 0.0), {}), InvalidInput);
  EXPECT_THROW((void)simulated_annealing(valley, all(6, 0.0), {.reach = all(5, 1.0)}), InvalidInput);
  EXPECT_THROW((void)simulated_annealing(valley, all(6, 0.0), {.reach = all(6, -1.0)}), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground::math
