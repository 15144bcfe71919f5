#include "myoid/ground/math/simulated_annealing.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/nelder_mead.h"

#include "tests/support/nist_problems.h"

namespace myoid::inline ground::math {
namespace {

/// Rastrigin: global minimum 0 at the origin, about 10^n local ones in [-5.12, 5.12]^n.
double rastrigin(const Eigen::VectorXd& x) {
  double sum = 10.0 * static_cast<double>(x.size());
  for (const double v : x) sum += v * v - 10.0 * std::cos(2.0 * std::numbers::pi * v);
  return sum;
}

DirectSearchProblem boxed(const CostFunction& cost, Eigen::Index n, double half) {
  return {.cost = cost, .lower = Eigen::VectorXd::Constant(n, -half), .upper = Eigen::VectorXd::Constant(n, half)};
}

TEST(SimulatedAnnealing, FindsTheGlobalMinimumAmongAHundredWhereTheSimplexDoesNot) {
  const Eigen::VectorXd start = Eigen::VectorXd::Constant(2, 4.3);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const DirectSearchResult result =
        simulated_annealing(boxed(rastrigin, 2, 5.12), start, {.seed = seed, .adjustments = 20});
    EXPECT_EQ(result.termination, Termination::converged) << result.message;
    // The cost is 200 |x|^2 near 0; 1e-8 times the spread of the costs (about 13) is |x| < 3e-5.
    EXPECT_LT(result.x.norm(), 1e-4) << "seed " << seed;
  }
  EXPECT_GT(nelder_mead(boxed(rastrigin, 2, 5.12), start, {.first_edge = 0.01}).cost, 1.0);
}

TEST(SimulatedAnnealing, FindsNistsBoxBodFromAnywhereInItsBox) {
  const test::NistProblem nist = test::read_nist("BoxBOD");
  DirectSearchProblem problem = direct_search_problem(test::least_squares(nist));
  problem.lower = Eigen::Vector2d(1.0, 0.01);
  problem.upper = Eigen::Vector2d(500.0, 10.0);
  const DirectSearchResult result = simulated_annealing(problem, Eigen::Vector2d(1.0, 1.0), {.cost_tolerance = 1e-10});
  EXPECT_EQ(result.termination, Termination::converged) << result.message;
  EXPECT_NEAR(2.0 * result.cost / nist.residual_sum_of_squares, 1.0, 1e-4);
  // Polished by the simplex to the certified parameters.
  const DirectSearchResult polished = nelder_mead(problem, result.x, {.first_edge = 1e-3});
  EXPECT_NEAR(polished.x[0] / nist.certified[0], 1.0, 1e-6);
  EXPECT_NEAR(polished.x[1] / nist.certified[1], 1.0, 1e-6);
}

TEST(SimulatedAnnealing, LeavesAWellThatNoDescentLeavesIfItIsHot) {
  // Wells at (-1, -1), cost 0.2, and (1, 1), cost 0, on a plateau of 1: a move of one coordinate
  // from the first never lands in the second, so that only rises that are accepted lead there.
  const auto wells = [](const Eigen::VectorXd& x) {
    return 1.0 - 0.8 * std::exp(-(x - Eigen::Vector2d(-1, -1)).squaredNorm() / 0.1) -
           std::exp(-(x - Eigen::Vector2d(1, 1)).squaredNorm() / 0.1);
  };
  const Eigen::VectorXd start = Eigen::Vector2d(-1.0, -1.0);
  const DirectSearchResult hot = simulated_annealing(boxed(wells, 2, 2.0), start, {.first_temperature = 1.0});
  EXPECT_NEAR(hot.x[0], 1.0, 1e-3);
  EXPECT_NEAR(hot.x[1], 1.0, 1e-3);
  const DirectSearchResult by_spread =
      simulated_annealing(boxed(wells, 2, 2.0), start, {.first_temperature = 1.0, .spread_cooling = 0.7});
  EXPECT_NEAR(by_spread.x[0], 1.0, 1e-3);
  const DirectSearchResult cold = simulated_annealing(boxed(wells, 2, 2.0), start, {.first_temperature = 1e-6});
  EXPECT_NEAR(cold.x[0], -1.0, 1e-3);
}

TEST(SimulatedAnnealing, FollowsCostsOverManyPowersOfTenWhereTheTemperatureFallsWithTheirSpread) {
  // A smooth valley, 4 times as long as wide, whose costs reach 1e13 in the box and 6 at its lowest: the last term
  // couples every pair of the six unknowns (eigenvalues 1 and 1 + 6 * 2.5 = 16).
  const Eigen::VectorXd lowest = Eigen::VectorXd::Constant(6, 0.3);
  const auto valley = [&](const Eigen::VectorXd& x) {
    const Eigen::VectorXd off = x - lowest;
    return 6.0 + 1e12 * (off.squaredNorm() + 2.5 * std::pow(off.sum(), 2));
  };
  const Eigen::VectorXd start = Eigen::VectorXd::Constant(6, -0.5);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const DirectSearchResult result = simulated_annealing(
        boxed(valley, 6, 1.0), start,
        {.seed = seed, .max_evaluations = 20000, .spread_cooling = 0.7, .cycles = 10, .adjustments = 1});
    EXPECT_LT(result.cost, 6.01) << seed;
    EXPECT_LT((result.x - lowest).norm(), 1e-6) << seed;
  }
}

TEST(SimulatedAnnealing, IsReproducibleBySeedAndCountsEvaluations) {
  int calls = 0;
  const DirectSearchProblem problem = boxed(
      [&](const Eigen::VectorXd& x) {
        ++calls;
        return rastrigin(x);
      },
      2, 5.12);
  const Eigen::VectorXd start = Eigen::Vector2d(3.0, -4.0);
  const DirectSearchResult a = simulated_annealing(problem, start, {.seed = 3});
  EXPECT_EQ(a.evaluations, calls);
  const DirectSearchResult b = simulated_annealing(problem, start, {.seed = 3});
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_NE(a.x, simulated_annealing(problem, start, {.seed = 4}).x);
  const DirectSearchResult cut = simulated_annealing(problem, start, {.seed = 3, .max_evaluations = 300});
  EXPECT_EQ(cut.termination, Termination::iteration_limit);
  EXPECT_EQ(cut.evaluations, 300);
}

TEST(SimulatedAnnealing, StaysInTheBoxAndTakesNotANumberForAWall) {
  // Minimum of (x-2)^2 + y^2 with x <= 1 and NaN for y < 0.25: at (1, 0.25).
  bool left = false;
  const DirectSearchResult result =
      simulated_annealing({.cost =
                               [&](const Eigen::VectorXd& x) {
                                 left = left || x[0] > 1.0 || x[0] < -1.0 || x[1] > 1.0 || x[1] < -1.0;
                                 if (x[1] < 0.25) return std::nan("");
                                 return std::pow(x[0] - 2.0, 2) + x[1] * x[1];
                               },
                           .lower = Eigen::Vector2d(-1.0, -1.0),
                           .upper = Eigen::Vector2d(1.0, 1.0)},
                          Eigen::Vector2d(0.0, 0.9));
  EXPECT_FALSE(left);
  EXPECT_NEAR(result.x[0], 1.0, 1e-5);
  EXPECT_NEAR(result.x[1], 0.25, 1e-5);
}

TEST(SimulatedAnnealing, GoesBeyondItsReachWhereNoBoundIs) {
  // From 0 with steps of at most 1 to a lowest point 5 away; points below -2 are out of bounds.
  const DirectSearchResult result = simulated_annealing(
      {.cost = [](const Eigen::VectorXd& x) { return (x - Eigen::Vector2d(5.0, -3.0)).squaredNorm(); },
       .lower = Eigen::Vector2d(-2.0, -2.0),
       .upper = {}},
      Eigen::Vector2d::Zero(), {.reach = Eigen::Vector2d(1.0, 1.0)});
  EXPECT_NEAR(result.x[0], 5.0, 1e-3);
  EXPECT_NEAR(result.x[1], -2.0, 1e-3);
}

TEST(SimulatedAnnealing, RefusesAnOpenBoxAndStrangeOptions) {
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(1);
  const DirectSearchProblem open{.cost = rastrigin, .lower = {}, .upper = {}};
  EXPECT_THROW((void)simulated_annealing(open, start), InvalidInput);
  const DirectSearchProblem box = boxed(rastrigin, 1, 1.0);
  EXPECT_THROW((void)simulated_annealing(box, start, {.cooling = 1.0}), InvalidInput);
  EXPECT_THROW((void)simulated_annealing(box, start, {.cycles = 0}), InvalidInput);
  EXPECT_THROW((void)simulated_annealing(box, start, {.reach = Eigen::VectorXd::Zero(2)}), InvalidInput);
  EXPECT_THROW((void)simulated_annealing(box, start, {.spread_cooling = -1.0}), InvalidInput);
  EXPECT_THROW((void)simulated_annealing(box, Eigen::VectorXd::Constant(1, std::nan(""))), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground::math
