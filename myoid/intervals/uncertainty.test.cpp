#include "myoid/intervals/uncertainty.h"

#include <vector>

#include <gtest/gtest.h>

#include "myoid/methods/torque.h"

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

using test::elbow_study;
using test::ElbowStudy;

TEST(Uncertainty, RoutesAgreeOnAWellBehavedRecording) {
  const ElbowStudy study = elbow_study({.trials = 8,
                                        .seconds = 10.0,
                                        .emg_cv = 0.05,
                                        .torque_sd_nm = 0.5,
                                        .truth_from_prior = true,
                                        .with_priors = true});
  EstimatorOptions options{.starts = 1};
  options.intervals = {.bootstrap = 60, .profile = true};
  const IdentificationResult r = identify_torque(study.data, options);
  EXPECT_EQ(r.bootstrap_replicates, 60);
  for (const ParameterEstimate& e : r.estimates) {
    if (e.parameter != "max_isometric_force" && e.parameter != "optimal_fiber_length") continue;
    ASSERT_EQ(e.routes.size(), 5U) << e.muscle << " " << e.parameter;
    const double width = *e.routes[0].high - *e.routes[0].low;
    // 60 replicates know a 95 % quantile to some 25 %; eight clusters a variance to 50 %.
    for (const RouteInterval& route : e.routes) {
      EXPECT_GT(*route.high - *route.low, 0.3 * width) << e.muscle << e.parameter << route.route;
      EXPECT_LT(*route.high - *route.low, 2.5 * width) << e.muscle << e.parameter << route.route;
    }
  }
  const IdentificationResult again = identify_torque(study.data, options);
  for (std::size_t i = 0; i < r.estimates.size(); ++i) {
    for (std::size_t k = 0; k < r.estimates[i].routes.size(); ++k)
      EXPECT_EQ(r.estimates[i].routes[k].high, again.estimates[i].routes[k].high);
  }
}

TEST(Uncertainty, AProfileHasTheScaleOfTheSandwichWhateverTheCostsIs) {
  // Plain least squares: the cost counts every sample in N m squared, as if each stood alone.
  const ElbowStudy study =
      elbow_study({.trials = 8, .seconds = 10.0, .torque_sd_nm = 0.05, .truth_from_prior = true, .with_priors = true});
  EstimatorOptions options{.priors = false, .weights = false, .starts = 1};
  options.intervals = {.profile = true};
  int checked = 0;
  for (const ParameterEstimate& e : identify_torque(study.data, options).estimates) {
    if (e.parameter != "max_isometric_force" && e.parameter != "emg_delay") continue;
    const RouteInterval& by_sandwich = e.routes.front();
    const RouteInterval& by_profile = e.routes.back();
    ASSERT_EQ(by_profile.route, "profile");
    const double width = *by_sandwich.high - *by_sandwich.low;
    EXPECT_NEAR((*by_profile.high - *by_profile.low) / width, 1.0, 0.1) << e.muscle << e.parameter;
    ++checked;
  }
  EXPECT_EQ(checked, 5);
}

TEST(Sandwich, WhatATrialMovesIsWhatTheFitWithoutItSays) {
  ElbowStudy study = elbow_study({.trials = 5,
                                  .seconds = 12.0,
                                  .emg_cv = 0.06,
                                  .torque_sd_nm = 0.4,
                                  .truth_from_prior = true,
                                  .with_priors = true});
  const Estimator estimator(study.data, {.correct_attenuation = false, .starts = 1});
  const Estimator::Solution all = estimator.solve(estimator.model().parameters().start());
  const Sandwich parts = sandwich(estimator, all);
  ASSERT_EQ(parts.trials.size(), 5U);
  ASSERT_TRUE(parts.jackknife);
  const Piece& piece = estimator.model().pieces()[2];
  Estimator::Variant without;
  without.multiplicity = Eigen::VectorXd::Ones(estimator.model().sample_count());
  without.multiplicity.segment(piece.first, piece.count).setZero();
  const NormalSearchResult fit = estimator.search(all.search.x, all.weighting, 1e-9, 1e-12, 100, without);
  const Eigen::VectorXd moved = fit.x - all.search.x;
  const Eigen::VectorXd sd = parts.model_based.diagonal().cwiseSqrt();
  for (Eigen::Index j = 0; j < moved.size(); ++j) {
    // One Newton step: right to the curvature of the problem, a third of a standard deviation.
    EXPECT_NEAR(parts.trial_shift(j, 2) / sd[j], moved[j] / sd[j], 0.35) << j;
  }
  EXPECT_GT(moved.cwiseQuotient(sd).cwiseAbs().maxCoeff(), 0.35);
}

TEST(Sandwich, SumsOverTrialsAreAsWideAsTheNoiseWhereTheModelIsRightAndTheJackknifeWider) {
  // One trial lasts as long as all others together: what it says no other can question.
  double over_trials = 0.0, jackknife = 0.0, count = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    ElbowStudy study = elbow_study({.trials = 8,
                                    .seconds = 6.0,
                                    .torque_sd_nm = 0.4,
                                    .truth_from_prior = true,
                                    .with_priors = true,
                                    .seed = seed});
    const ElbowStudy longer = elbow_study({.trials = 1,
                                           .seconds = 42.0,
                                           .torque_sd_nm = 0.4,
                                           .truth_from_prior = true,
                                           .with_priors = true,
                                           .seed = seed});
    study.data.trials[0] = longer.data.trials[0];
    const Estimator estimator(study.data, {.correct_attenuation = false, .starts = 1});
    const Estimator::Solution all = estimator.solve(estimator.model().parameters().start());
    const Sandwich parts = sandwich(estimator, all);
    ASSERT_TRUE(parts.cluster);
    for (Eigen::Index j = 0; j < all.search.x.size(); ++j) {
      over_trials += (*parts.cluster)(j, j) / parts.model_based(j, j);
      jackknife += (*parts.jackknife)(j, j) / parts.model_based(j, j);
      count += 1.0;
    }
  }
  // Eight sums know a variance to 50 %; eight studies and some parameters, that hang together, to 15 % or so.
  EXPECT_NEAR(over_trials / count, 1.0, 0.3);
  EXPECT_GT(jackknife, over_trials);
}

TEST(Sandwich, WhereNothingIsMultipliedByEmgItsNoiseMovesNothing) {
  // The joint's own torque alone: no muscle is an unknown.
  ElbowStudy study = elbow_study({.trials = 2, .seconds = 10.0, .torque_sd_nm = 0.5});
  for (MuscleSetup& setup : study.data.muscles) {
    for (const muscle::HillField& field : muscle::kHillFields) setup.fixed.emplace_back(field.name);
  }
  study.data.rules.push_back({.parameter = "joint_torque_offset", .free = true, .prior_mean = 0.0, .prior_sd = 1.0});
  const Estimator still(study.data, {.delay_s = 0.05, .starts = 1});
  const Estimator::Solution solution = still.solve(still.model().parameters().start());
  EXPECT_EQ(sandwich(still, solution).by_noise.norm(), 0.0);
  // With strengths to find it moves them, and towards stronger ones: more noise, more to make up for.
  const ElbowStudy whole =
      elbow_study({.trials = 2, .seconds = 10.0, .emg_cv = 0.08, .torque_sd_nm = 0.5, .with_priors = true});
  EstimatorOptions options{.starts = 1};
  for (const char* channel : {"BIC", "BRA", "BRD", "TRI"}) options.emg_bandwidth_hz[channel] = 432.0;
  const Estimator moving(whole.data, options);
  const Estimator::Solution found = moving.solve(moving.model().parameters().start());
  const Eigen::VectorXd moved = sandwich(moving, found).by_noise;
  double strengths = 0.0;
  for (std::size_t j = 0; j < moving.free().size(); ++j) {
    if (moving.free()[j].field->name == "max_isometric_force") strengths += moved[static_cast<Eigen::Index>(j)];
  }
  EXPECT_GT(strengths, 0.0);
}

TEST(CollinearSets, AreThoseWithAnEigenvalueNearZero) {
  // Columns a, b, a + b (+ a little), d: only the set of three is bad.
  Eigen::MatrixXd x(6, 4);
  x << 1, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1e-3, 0, 0, 0, 0, 1, 2, -1, 1, 0.3, 0.5, 0.2, 0.7, -1;
  const std::vector<CollinearSet> sets = collinear_sets(x.transpose() * x);
  ASSERT_EQ(sets.size(), 1U);
  EXPECT_EQ(sets[0].parameters, (std::vector<Eigen::Index>{0, 1, 2}));
  EXPECT_GT(sets[0].index, 100.0);
}

}  // namespace
}  // namespace myoid::identification
