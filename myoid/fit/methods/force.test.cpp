#include "myoid/fit/methods/force.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "myoid/fit/methods/prediction.h"
#include "myoid/fit/methods/torque.h"

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

using test::elbow_study;
using test::ElbowStudy;

TEST(IdentifyForce, GivesBothBranchesBackAtOnce) {
  const ElbowStudy study = elbow_study({.trials = 2});
  ForceOptions options;
  options.detect_exact = true;
  const IdentificationResult r = identify_force(study.data, options);
  EXPECT_TRUE(r.exact);
  int seen = 0;
  for (const ParameterEstimate& e : r.estimates) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (study.data.muscles[k].name != e.muscle || e.parameter == "emg_delay") continue;
      const double truth = study.truth[k].*muscle::hill_field(e.parameter).member;
      EXPECT_NEAR(e.estimate, truth, 1e-6 * truth) << e.muscle << " " << e.parameter;
      ++seen;
    }
  }
  EXPECT_EQ(seen, 24);
}

TEST(IdentifyForce, ForcesThatAnOptimizerAssignedIdentifyNothing) {
  const StudyData data =
      elbow_study({.trials = 2, .seconds = 8.0, .rate_hz = 50.0, .delay_s = 0.0, .with_priors = true}).data;
  const IdentificationResult found = identify_force(data, {.shared_forces = true});
  ASSERT_FALSE(found.estimates.empty());
  for (const ParameterEstimate& e : found.estimates) {
    EXPECT_GE(severity(e.verdict), severity(Verdict::prior_dominated)) << e.muscle << " " << e.parameter;
    EXPECT_FALSE(e.ci_low || e.ci_high || e.given_ci_low || e.given_ci_high);
  }
}

TEST(IdentifyForce, FollowsTheEmgAsItIsTold) {
  // Forces behind lags: each muscle alone would choose lags, the result says what all were told.
  ElbowStudy study = elbow_study({.trials = 1, .delay_s = 0.08, .with_priors = true});
  test::StudyNoise noise(1);
  for (TrialData& trial : study.data.trials) {
    trial.force_n = predict(study.data, trial, study.truth, study.delay_s, EmgLag::shared).force_n;
    for (auto column : trial.force_n.colwise()) column += 2.0 * noise.band(column.size(), 6.0, 100.0);
  }
  for (const bool choose : {false, true}) {
    for (const EmgLag lag : {EmgLag::delay, EmgLag::shared}) {
      const IdentificationResult r = identify_force(study.data, {.estimator = {.law = lag, .choose_lag = choose}});
      ASSERT_EQ(r.trials.size(), 1U);
      const auto& measured = study.data.trials[0].force_n;
      const double rmse_n =
          std::sqrt((r.trials[0].force_fit_n - measured).squaredNorm() / static_cast<double>(measured.size()));
      EXPECT_EQ(r.lag, lag);
      EXPECT_EQ(rmse_n < 3.0, lag == EmgLag::shared) << rmse_n;
    }
  }
}

TEST(IdentifyForce, ByThePosteriorEachNumberHasTwoReadingsThatHoldThePerson) {
  ElbowStudy study = elbow_study({.trials = 2, .seconds = 10.0, .emg_cv = 0.1, .with_priors = true});
  ForceOptions options;
  options.detect_exact = true;
  for (MuscleSetup& muscle : study.data.muscles) {
    muscle.fixed = {"tendon_slack_length"};
    options.estimator.state(muscle.emg_channel).gain_sd = 0.1;
  }
  test::StudyNoise noise(2);
  for (TrialData& trial : study.data.trials) {
    trial.force_n = predict(study.data, trial, study.truth, study.delay_s).force_n;
    for (auto column : trial.force_n.colwise())
      column += 0.02 * column.cwiseAbs().mean() * noise.band(column.size(), 6.0, 100.0);
  }
  const IdentificationResult r = identify_force(study.data, options);
  EXPECT_EQ(r.termination, math::Termination::converged) << r.message;
  EXPECT_FALSE(r.exact);
  EXPECT_GT(r.r2, 0.9);
  int held = 0, all = 0;
  for (const ParameterEstimate& e : r.estimates) {
    EXPECT_EQ(e.method, Method::force);
    EXPECT_FALSE(is_voluntary(e.parameter));
    ASSERT_TRUE(e.given_estimate && e.given_ci_low && e.given_ci_high && e.variance_shares);
    for (std::size_t k = 0; k < 4; ++k) {
      if (e.muscle != study.data.muscles[k].name ||
          std::ranges::count(muscle::kHillFields, e.parameter, &muscle::HillField::name) == 0)
        continue;
      const double truth = study.truth[k].*muscle::hill_field(e.parameter).member;
      held += truth >= *e.ci_low && truth <= *e.ci_high;
      ++all;
      // What is left of the geometry is a stiff tendon that may stretch; the size of F_max has none of it.
      if (e.parameter == "max_isometric_force") {
        EXPECT_LT((*e.variance_shares)[static_cast<std::size_t>(Source::geometry)], 0.1) << e.muscle;
      }
    }
  }
  EXPECT_EQ(all, 4 * 6);
  EXPECT_GE(held, 22);  // of 24 intervals of 95 % one or two miss
  // Each muscle's force in each trial, by the other trial.
  const std::vector<Fold> folds = cross_validate_force(study.data, options.estimator, {});
  ASSERT_EQ(folds.size(), 4U * 2U);
  for (std::size_t f = 0; f < folds.size(); ++f) {
    EXPECT_EQ(folds[f].joint, study.data.muscles[f / 2].name);
    EXPECT_EQ(folds[f].trial, study.data.trials[f % 2].name);
    EXPECT_EQ(folds[f].measured_nm, study.data.trials[f % 2].force_n.col(static_cast<Eigen::Index>(f / 2)));
    EXPECT_GT(folds[f].identified.r2(), 0.9) << folds[f].joint;
  }
}

}  // namespace
}  // namespace myoid::fit
