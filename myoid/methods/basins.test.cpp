#include "myoid/methods/basins.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "myoid/methods/force.h"
#include "myoid/methods/paper.h"
#include "myoid/methods/prediction.h"
#include "myoid/methods/torque.h"

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

const StartBox kBox{.given = Eigen::VectorXd::Constant(1, 0.9),
                    .spread = Eigen::VectorXd::Constant(1, 0.5),
                    .lower = Eigen::VectorXd::Constant(1, -1.0),
                    .upper = Eigen::VectorXd::Constant(1, 1.0)};

/// Two valleys, at -0.5 with cost 10 and at 0.5 with `higher`; the search ends in its start's,
/// short of convergence from beyond 0.8 and nowhere from below -0.9.
math::LocalMinimum descend(const Eigen::VectorXd& start, double higher) {
  if (start[0] < -0.9) return {math::Termination::not_finite, start, std::numeric_limits<double>::infinity(), 1};
  const bool right = start[0] > 0.0;
  return {start[0] > 0.8 ? math::Termination::iteration_limit : math::Termination::converged,
          Eigen::VectorXd::Constant(1, right ? 0.5 : -0.5), right ? higher : 10.0, 1};
}

TEST(Basins, TellHowManyStartsEndedWhereAndHowFarFromTheBest) {
  const BasinTable table = find_basins([](const Eigen::VectorXd& x) { return descend(x, 13.0); }, kBox, 65);
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

TEST(Basins, AMinimumAsGoodOutsideOfAnIntervalIsSaid) {
  std::vector<Unknown> free(1);
  free[0].field = &parameter_field("optimal_fiber_length");
  free[0].owner = "BRA";
  const auto reported = [&](double other_m, double other_cost, int converged) {
    IdentificationResult result;
    result.estimates.push_back({.muscle = "BRA",
                                .parameter = "optimal_fiber_length",
                                .estimate = 0.07,
                                .ci_low = 0.06,
                                .ci_high = 0.08,
                                .verdict = Verdict::identified});
    BasinTable table;
    table.starts = 24;
    table.basins.push_back(
        {.x = Eigen::VectorXd::Constant(1, other_m), .cost = other_cost, .starts = 5, .converged = converged});
    report_other_minima(table, free, 100.0, result);
    return result;
  };
  const IdentificationResult lower = reported(0.096, 90.0, 5);
  ASSERT_EQ(lower.warnings.size(), 1U);
  EXPECT_NE(lower.warnings[0].find("5 of 24 other starts"), std::string::npos);
  EXPECT_NE(lower.warnings[0].find("chi-square less by 20.0"), std::string::npos);
  EXPECT_EQ(lower.estimates[0].verdict, Verdict::weak);
  EXPECT_EQ(reported(0.096, 101.9, 5).warnings.size(), 1U);
  EXPECT_TRUE(reported(0.096, 102.1, 5).warnings.empty());  // a chi-square of 4.2 worse
  EXPECT_TRUE(reported(0.075, 90.0, 5).warnings.empty());   // within the interval
  EXPECT_TRUE(reported(0.096, 90.0, 0).warnings.empty());   // no minimum
}

TEST(Basins, ARivalIsWithinAChiSquareOfFourOfTheBest) {
  const auto rival = [](double higher, Eigen::Index plain_samples) {
    return find_basins([&](const Eigen::VectorXd& x) { return descend(x, higher); }, kBox, 9, plain_samples)
        .basins.at(1)
        .rival;
  };
  EXPECT_TRUE(rival(11.9, 0));
  EXPECT_FALSE(rival(12.1, 0));
  // Without weights the residuals' own variance is 2 C / n: 0.2 of 100 samples.
  EXPECT_TRUE(rival(10.38, 100));
  EXPECT_FALSE(rival(10.42, 100));
}

TEST(Basins, AnEndWithoutConvergenceWhereNoOtherConvergedIsNoBasin) {
  const auto search = [](const Eigen::VectorXd& x) {
    math::LocalMinimum end = descend(x, 13.0);
    if (x[0] > 0.0) end.termination = math::Termination::iteration_limit;
    return end;
  };
  const BasinTable table = find_basins(search, kBox, 65);
  ASSERT_EQ(table.basins.size(), 1U);
  EXPECT_EQ(table.basins[0].starts + table.failed, 65);
  EXPECT_GT(table.failed, 30);
}

/// Two trials of which one muscle's numbers follow; its start is `off` of the truth.
test::ElbowStudy forces_from(double off) {
  test::ElbowStudy study = test::elbow_study({.trials = 2, .seconds = 6.0, .delay_s = 0.0});
  study.data.muscles[0].start = study.truth[0];
  study.data.muscles[0].start.optimal_fiber_length_m *= off;
  return study;
}

TEST(Basins, OfThePublishedMethodAndOfOursHaveTheTruthOfExactDataForTheirBest) {
  const test::ElbowStudy study = forces_from(1.05);
  const double l0 = study.truth[0].optimal_fiber_length_m;
  const IdentificationResult paper = identify_paper(study.data, {.multistart = 9, .muscles = {"BIC"}});
  ASSERT_EQ(paper.basins.size(), 2U);
  EXPECT_EQ(paper.basins[0].fit, "BIC shortening");
  EXPECT_EQ(paper.basins[1].fit, "BIC lengthening");
  EXPECT_EQ(paper.basins[0].starts, 9);
  EXPECT_NEAR(paper.basins[0].basins[0].x[0], l0, 1e-6 * l0);
  const IdentificationResult force =
      identify_force(study.data, {.estimator = {.muscles = {"BIC"}, .multistart = 9}, .detect_exact = true});
  ASSERT_EQ(force.basins.size(), 1U);
  EXPECT_EQ(force.basins[0].fit, "BIC");
  EXPECT_EQ(force.basins[0].starts, 9);
  EXPECT_LT(force.basins[0].basins[0].cost, 1e-6);
}

TEST(Basins, AFitFromSeveralStartsEndsInTheLowest) {
  // EMG of 8 Hz with some of 1.1 Hz, and a delay of 120 ms as the only unknown: one period earlier
  // there is a second minimum, not quite as good, and the given start of 50 ms is nearer to it.
  test::ElbowStudy study = test::elbow_study({.trials = 1, .seconds = 8.0, .delay_s = 0.0});
  TrialData& trial = study.data.trials[0];
  Eigen::MatrixXd emg(trial.activation.sample_count(), trial.activation.channel_count());
  for (Eigen::Index i = 0; i < emg.rows(); ++i) {
    const double t = trial.activation.time_s()[i];
    emg.row(i).setConstant(0.4 + 0.2 * std::sin(16.0 * kPi * t) + 0.05 * std::sin(2.2 * kPi * t));
  }
  trial.activation = TimeSeries(trial.activation.time_s(), trial.activation.channels(), emg);
  for (std::size_t k = 0; k < 4; ++k) {
    study.data.muscles[k].start = study.truth[k];
    study.data.muscles[k].fixed = {"max_isometric_force",  "optimal_fiber_length", "force_length_width",
                                   "concentric_curvature", "eccentric_plateau",    "eccentric_curvature_product"};
  }
  trial.torque_nm = predict(study.data, trial, study.truth, 0.12).torque_nm;
  TorqueOptions options{.delay_prior_mean_s = 0.05,
                        .delay_prior_sd_s = 0.04,
                        .residual_cutoff_hz = std::nullopt,
                        .model_error = false,
                        .correct_attenuation = false,
                        .starts = 1};
  EXPECT_LT(identify_torque(study.data, options).delay_s, 0.01);
  options.multistart = 16;
  const IdentificationResult fit = identify_torque(study.data, options);
  EXPECT_NEAR(fit.delay_s, 0.12, 1e-3);
  ASSERT_EQ(fit.basins.size(), 1U);
  ASSERT_GE(fit.basins[0].basins.size(), 2U);
  EXPECT_FALSE(fit.basins[0].basins[0].given);
  EXPECT_TRUE(fit.basins[0].basins[1].given);
  EXPECT_FALSE(fit.basins[0].basins[1].rival);
}

}  // namespace
}  // namespace myoid::identification
