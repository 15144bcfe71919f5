#include "myoid/fit/methods/basins.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "myoid/fit/methods/paper.h"

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

const StartBox kBox{.given = Eigen::VectorXd::Constant(1, 0.9),
                    .spread = Eigen::VectorXd::Constant(1, 0.5),
                    .lower = Eigen::VectorXd::Constant(1, -1.0),
                    .upper = Eigen::VectorXd::Constant(1, 1.0)};

/// Two valleys, at -0.5 with cost 10 and at 0.5 with `higher`; the search ends in its start's,
/// short of convergence from beyond 0.8 and nowhere from below -0.9.
LocalMinimum descend(const Eigen::VectorXd& start, double higher) {
  if (start[0] < -0.9) return {math::Termination::not_finite, start, std::numeric_limits<double>::infinity(), 1};
  const bool right = start[0] > 0.0;
  return {start[0] > 0.8 ? math::Termination::iteration_limit : math::Termination::converged,
          Eigen::VectorXd::Constant(1, right ? 0.5 : -0.5), right ? higher : 10.0, 1};
}

TEST(Basins, TellHowManyStartsEndedWhereAndHowFarFromTheBest) {
  const BasinTable table = find_basins([](const Eigen::VectorXd& x) { return descend(x, 13.0); }, kBox, 65, 20);
  EXPECT_EQ(table.starts, 65);
  ASSERT_EQ(table.basins.size(), 2U);
  const BasinRow& best = table.basins[0];
  const BasinRow& other = table.basins[1];
  EXPECT_EQ(best.x[0], -0.5);
  EXPECT_EQ(best.cost, 10.0);
  EXPECT_EQ(best.distance, 0.0);
  EXPECT_TRUE(best.rival);
  EXPECT_EQ(other.cost, 13.0);
  EXPECT_EQ(other.distance, 2.0);  // 1 at a spread of 0.5
  EXPECT_FALSE(other.rival);
  EXPECT_FALSE(best.given);
  EXPECT_TRUE(other.given);
  // Sobol points are even: a twentieth of them each below -0.9 and nearly a half in either valley;
  // the given start is one beyond 0.8.
  EXPECT_NEAR(table.failed, 0.05 * 64, 1.0);
  EXPECT_EQ(best.starts, best.converged);
  EXPECT_NEAR(other.starts, 33, 1);
  EXPECT_NEAR(other.starts - other.converged, 1 + 0.1 * 64, 1.0);
  EXPECT_EQ(best.starts + other.starts + table.failed, 65);
}

TEST(Basins, ARivalIsWithinAChiSquareOfFourOfTheBest) {
  const auto rival = [](double higher, Eigen::Index samples) {
    return find_basins([&](const Eigen::VectorXd& x) { return descend(x, higher); }, kBox, 9, samples)
        .basins.at(1)
        .rival;
  };
  // The residuals' own variance is 2 C / n: 0.2 of 100 samples.
  EXPECT_TRUE(rival(10.38, 100));
  EXPECT_FALSE(rival(10.42, 100));
}

TEST(Basins, AnEndWithoutConvergenceWhereNoOtherConvergedIsNoBasin) {
  const auto search = [](const Eigen::VectorXd& x) {
    LocalMinimum end = descend(x, 13.0);
    if (x[0] > 0.0) end.termination = math::Termination::iteration_limit;
    return end;
  };
  const BasinTable table = find_basins(search, kBox, 65, 20);
  ASSERT_EQ(table.basins.size(), 1U);
  EXPECT_EQ(table.basins[0].starts + table.failed, 65);
  EXPECT_GT(table.failed, 30);
}

/// Descends (x^2 - 1)^2 / 2 + s^2 (x - 1)^2 / 2 of each unknown, which has minima near -1 and at 1.
LocalSearch double_wells(double s) {
  return [s](const Eigen::VectorXd& start) {
    const math::LeastSquaresProblem problem{
        .residual_count = 2 * start.size(),
        .evaluate = [s](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
          if (jacobian != nullptr) jacobian->setZero();
          for (Eigen::Index k = 0; k < x.size(); ++k) {
            r[2 * k] = x[k] * x[k] - 1.0;
            r[2 * k + 1] = s * (x[k] - 1.0);
            if (jacobian == nullptr) continue;
            (*jacobian)(2 * k, k) = 2.0 * x[k];
            (*jacobian)(2 * k + 1, k) = s;
          }
        }};
    const math::LeastSquaresResult end = math::minimize(problem, start);
    return LocalMinimum{end.termination, end.x, end.cost, end.evaluations};
  };
}

TEST(Basins, OfDoubleWellsAreAllInOrderOfCost) {
  // Three unknowns, two wells each: 8 minima. dC/dx = 0 besides x = 1: 2x(x+1) + s^2 = 0.
  const double s = 0.1, left = (-1.0 - std::sqrt(1.0 - 2.0 * s * s)) / 2.0;
  const double cost = 0.5 * (std::pow(left * left - 1.0, 2) + s * s * std::pow(left - 1.0, 2));
  const StartBox box{.given = Eigen::Vector3d::Constant(0.3),
                     .spread = Eigen::Vector3d::Ones(),
                     .lower = Eigen::Vector3d::Constant(-2.0),
                     .upper = Eigen::Vector3d::Constant(2.0)};
  const BasinTable table = find_basins(double_wells(s), box, 65, 100);
  ASSERT_EQ(table.basins.size(), 8U);
  int starts = 0;
  for (std::size_t b = 0; b < 8; ++b) {
    // Costs are 0, 1, 1, 1, 2, 2, 2, 3 times that of one left well.
    EXPECT_NEAR(table.basins[b].cost, (b == 0 ? 0.0 : b < 4 ? 1.0 : b < 7 ? 2.0 : 3.0) * cost, 1e-10);
    for (const double x : table.basins[b].x) EXPECT_NEAR(x, x > 0.0 ? 1.0 : left, 1e-6);
    starts += table.basins[b].converged;
  }
  EXPECT_EQ(starts, 65);
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const BasinTable single = find_basins(double_wells(s), box, 65, 100);
  for (std::size_t b = 0; b < 8; ++b) {
    EXPECT_EQ(single.basins.at(b).x, table.basins[b].x);
    EXPECT_EQ(single.basins[b].starts, table.basins[b].starts);
  }
}

/// Two trials of which one muscle's numbers follow; its start is `off` of the truth.
test::ElbowStudy forces_from(double off) {
  test::ElbowStudy study = test::elbow_study({.trials = 2, .seconds = 6.0, .delay_s = 0.0});
  study.data.muscles[0].start = study.truth[0];
  study.data.muscles[0].start.optimal_fiber_length_m *= off;
  return study;
}

TEST(Basins, OfThePublishedMethodHaveTheTruthOfExactDataForTheirBest) {
  const test::ElbowStudy study = forces_from(1.05);
  const double l0 = study.truth[0].optimal_fiber_length_m;
  const IdentificationResult paper = identify_paper(study.data, {.multistart = 9, .muscles = {"BIC"}});
  ASSERT_EQ(paper.basins.size(), 2U);
  EXPECT_EQ(paper.basins[0].fit, "BIC shortening");
  EXPECT_EQ(paper.basins[1].fit, "BIC lengthening");
  EXPECT_EQ(paper.basins[0].starts, 9);
  EXPECT_NEAR(paper.basins[0].basins[0].x[0], l0, 1e-6 * l0);
}

test::ElbowStudy small_study() { return test::elbow_study({.trials = 1, .seconds = 4.0, .with_priors = true}); }

TEST(StartBox, OfThePublishedMethodTurnsAPriorOfALogarithmIntoItsOwnUnit) {
  test::ElbowStudy study = small_study();
  study.data.muscles[0].priors["optimal_fiber_length"] = {0.1, 0.05, true};
  study.data.muscles[0].priors["force_length_width"] = {0.05, 0.004, false};
  study.data.muscles[0].priors.erase("concentric_curvature");
  const PaperCase samples = paper_case(study.data, 0, true);
  const StartBox box = start_box(samples, study.data.muscles[0]);
  ASSERT_EQ(box.given.size(), 3);  // l0, l_sh, V_sh
  EXPECT_DOUBLE_EQ(box.spread[0], 0.05 * box.given[0]);
  EXPECT_DOUBLE_EQ(box.spread[1], 0.004);
  EXPECT_DOUBLE_EQ(box.spread[2], 0.1 * box.given[2]);
  EXPECT_DOUBLE_EQ(box.upper[1], box.given[1] + 0.008);
}

StartBox unit_box(Eigen::Index unknowns) {
  return {.given = Eigen::VectorXd::Constant(unknowns, 0.1),
          .spread = Eigen::VectorXd::Constant(unknowns, 0.25),
          .lower = Eigen::VectorXd::Zero(unknowns),
          .upper = Eigen::VectorXd::Ones(unknowns)};
}

TEST(StartBox, StartsAreTheGivenOneAndPointsThatFillTheBox) {
  const StartBox box = unit_box(3);
  const auto starts = starts_in(box, 65);
  ASSERT_EQ(starts.size(), 65U);
  EXPECT_EQ(starts[0], box.given);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t s = 1; s < starts.size(); ++s) {
    EXPECT_GT(starts[s].minCoeff(), 0.0);
    EXPECT_LT(starts[s].maxCoeff(), 1.0);
    mean += starts[s] / 64.0;
  }
  EXPECT_LT((mean - Eigen::Vector3d::Constant(0.5)).norm(), 0.05);
  EXPECT_EQ(starts_in(box, 1).size(), 1U);
}

TEST(StartBox, DistanceIsTheRootMeanSquareInSpreads) {
  const StartBox box = unit_box(4);
  EXPECT_DOUBLE_EQ(distance(box.given, box.given.array() + 0.5, box), 2.0);
}

}  // namespace
}  // namespace myoid::fit
