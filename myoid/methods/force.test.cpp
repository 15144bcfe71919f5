#include "myoid/methods/force.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/methods/prediction.h"
#include "myoid/methods/torque.h"

#include "tests/support/elbow_study.h"

namespace myoid::identification {
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

TEST(IdentifyForce, FollowsTheEmgAsItIsTold) {
  // Forces behind lags: each muscle alone would choose lags, the result says what all were told.
  ElbowStudy study = elbow_study({.trials = 1, .delay_s = 0.08});
  test::StudyNoise noise(1);
  for (TrialData& trial : study.data.trials) {
    trial.force_n = predict(study.data, trial, study.truth, study.delay_s, EmgLag::shared).force_n;
    for (auto column : trial.force_n.colwise()) column += 2.0 * noise.band(column.size(), 6.0, 100.0);
  }
  for (const bool choose : {false, true}) {
    for (const EmgLag lag : {EmgLag::delay, EmgLag::shared}) {
      const IdentificationResult r = identify_force(study.data, {.estimator = {.lag = lag, .choose_lag = choose}});
      ASSERT_EQ(r.trials.size(), 1U);
      const auto& measured = study.data.trials[0].force_n;
      const double rmse_n =
          std::sqrt((r.trials[0].force_fit_n - measured).squaredNorm() / static_cast<double>(measured.size()));
      EXPECT_EQ(r.lag, lag);
      EXPECT_EQ(rmse_n < 3.0, lag == EmgLag::shared) << rmse_n;
    }
  }
}

}  // namespace
}  // namespace myoid::identification
