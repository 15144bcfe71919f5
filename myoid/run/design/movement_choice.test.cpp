#include "myoid/run/design/movement_choice.h"

#include <cmath>
#include <random>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::run {
namespace {

/// Random information matrices: the normal matrices of random Jacobians.
DesignProblem random_problem(unsigned seed, int p, int movements, int persons) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  DesignProblem problem;
  for (int j = 0; j < p; ++j) problem.parameters.push_back("p" + std::to_string(j));
  problem.prior_precision = Eigen::MatrixXd::Identity(p, p);
  problem.targets = {0, 1};
  for (int m = 0; m < movements; ++m) {
    MovementInformation movement{"m" + std::to_string(m), 10.0, {}};
    for (int person = 0; person < persons; ++person) {
      Eigen::MatrixXd jacobian(2, p);
      for (double& x : jacobian.reshaped()) x = 2.0 * normal(engine);
      movement.per_person.push_back(jacobian.transpose() * jacobian);
    }
    problem.catalogue.push_back(std::move(movement));
  }
  return problem;
}

/// The criterion from its definition, by explicit inverse and determinant.
double d_criterion(const DesignProblem& problem, const std::vector<std::size_t>& chosen) {
  double sum = 0.0;
  const std::size_t persons = problem.catalogue[0].per_person.size();
  for (std::size_t person = 0; person < persons; ++person) {
    Eigen::MatrixXd precision = problem.prior_precision;
    for (const std::size_t m : chosen) precision += problem.catalogue[m].per_person[person];
    const Eigen::MatrixXd s = precision.inverse();
    sum += std::log(s.topLeftCorner(2, 2).determinant());
  }
  return sum / static_cast<double>(persons);
}

TEST(ChooseMovements, FindsNearlyWhatTryingAllTriplesFinds) {
  // An exchange ends in a choice that no single swap improves; among 12 movements that is the best
  // of all triples, or loses less than a hundredth of the gain.
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const DesignProblem problem = random_problem(seed, 4, 12, 3);
    const DesignResult result = choose_movements(problem, {.movements = 3, .most_of_each = 1});
    ASSERT_EQ(result.steps.size(), 3U);
    double best = 0.0;
    for (std::size_t a = 0; a < 12; ++a)
      for (std::size_t b = 0; b < a; ++b)
        for (std::size_t c = 0; c < b; ++c) best = std::min(best, d_criterion(problem, {a, b, c}));
    const double found = result.steps.back().criterion;
    EXPECT_NEAR(found,
                d_criterion(problem, {result.steps[0].movement, result.steps[1].movement, result.steps[2].movement}),
                1e-9);
    EXPECT_LE(found, best + 0.01 * std::abs(best)) << seed;
  }
}

TEST(ChooseMovements, EveryStepShrinksTheIntervalsAndTheCriterion) {
  for (const DesignCriterion criterion : {DesignCriterion::d_optimal, DesignCriterion::a_optimal}) {
    const DesignResult result = choose_movements(random_problem(5, 6, 20, 4), {.criterion = criterion, .movements = 6});
    Eigen::VectorXd sd = result.prior_sd;
    double value = result.prior_criterion;
    for (const DesignStep& step : result.steps) {
      EXPECT_LT(step.criterion, value);
      EXPECT_TRUE((step.sd.array() <= sd.array() + 1e-12).all());
      value = step.criterion;
      sd = step.sd;
    }
  }
}

TEST(ChooseMovements, TellsApartWhatTheTargetsNeed) {
  // Movement 0 tells much of a parameter that nobody asks for, movement 1 little of the target.
  DesignProblem problem;
  problem.parameters = {"target", "nuisance"};
  problem.prior_precision = Eigen::MatrixXd::Identity(2, 2);
  problem.targets = {0};
  problem.catalogue = {{"of the other", 10.0, {Eigen::Vector2d(0.0, 100.0).asDiagonal()}},
                       {"of the target", 10.0, {Eigen::Vector2d(1.0, 0.0).asDiagonal()}}};
  const DesignResult result = choose_movements(problem, {.movements = 1});
  EXPECT_EQ(result.steps[0].movement, 1U);
  // Information 1 beside a prior precision of 1: the variance halves.
  EXPECT_NEAR(result.steps[0].sd[0], std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(result.steps[0].criterion, std::log(0.5), 1e-12);
}

TEST(ChooseMovements, KeepsTheBudgetTheRepetitionsAndWhatPeopleCanDo) {
  DesignProblem problem = random_problem(3, 4, 6, 5);
  problem.catalogue[2].duration_s = 100.0;
  for (std::size_t person = 0; person < 2; ++person) problem.catalogue[4].per_person[person] = Eigen::MatrixXd();
  const DesignResult result = choose_movements(problem, {.movements = 10, .most_of_each = 2, .budget_s = 65.0});
  EXPECT_EQ(result.steps.size(), 6U);
  std::vector<int> count(6, 0);
  for (const DesignStep& step : result.steps) ++count[step.movement];
  EXPECT_EQ(count[2], 0);
  EXPECT_EQ(count[4], 0);
  for (const int c : count) EXPECT_LE(c, 2);
  EXPECT_EQ(result.infeasible, std::vector<std::size_t>{4});
}

TEST(ChooseMovements, RefusesWhatDoesNotFitTogether) {
  DesignProblem problem = random_problem(3, 4, 6, 2);
  problem.targets.clear();
  EXPECT_THROW((void)choose_movements(problem), InvalidInput);
  problem = random_problem(3, 4, 6, 2);
  problem.catalogue[1].per_person[0] = Eigen::MatrixXd::Identity(3, 3);
  EXPECT_THROW((void)choose_movements(problem), InvalidInput);
  problem = random_problem(3, 4, 6, 2);
  for (auto& movement : problem.catalogue)
    for (auto& m : movement.per_person) m = Eigen::MatrixXd();
  EXPECT_THROW((void)choose_movements(problem), InvalidInput);
}

TEST(Movement, ARangeBelowZeroHasNoDashBesideItsMinus) {
  const Movement turn{.kind = MovementKind::isokinetic, .lowest_rad = -51.0 * kDegree, .highest_rad = -15.0 * kDegree};
  EXPECT_EQ(turn.description().find("--"), std::string::npos);
  EXPECT_NE(turn.description().find("-51 to -15"), std::string::npos);
}

}  // namespace
}  // namespace myoid::run
