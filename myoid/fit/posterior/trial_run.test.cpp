#include "myoid/fit/posterior/trial_run.h"

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::fit {
namespace {

TEST(TrialRuns, AreNoLongerThanEightSecondsAndKnowTheirPlaceInTheSession) {
  test::ElbowStudy study = test::elbow_study({.trials = 2, .seconds = 30.0});
  const ParameterMap map(study.data, {});
  const std::vector<TrialRun> runs = trial_runs(study.data, {}, map);
  ASSERT_EQ(runs.size(), 8U);
  for (const TrialRun& run : runs) {
    const Eigen::Index n = run.time_s.size();
    // And the samples that it shares with its neighbor.
    EXPECT_LE(run.time_s[n - 1] - run.time_s[0], 8.5);
    EXPECT_NEAR(run.interval_s, 0.05, 1e-9);
    EXPECT_EQ(run.measured_nm.size(), run.reduction.outputs());
  }
  EXPECT_EQ(runs[3].trial, 0);
  EXPECT_EQ(runs[4].trial, 1);
  EXPECT_NEAR(runs[0].session, 0.0625, 0.01);
  EXPECT_NEAR(runs[7].session, 0.9375, 0.01);
}

TEST(TrialRuns, DoNotReachAcrossWhatIsLeftOut) {
  test::ElbowStudy study = test::elbow_study({.trials = 1, .seconds = 15.0});
  study.data.trials[0].excluded = {{.begin_s = 6.0, .end_s = 8.0}};
  const ParameterMap map(study.data, {});
  const std::vector<TrialRun> runs = trial_runs(study.data, {}, map);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_LT(runs[0].time_s[runs[0].time_s.size() - 1], 6.0);
  EXPECT_GT(runs[1].time_s[0], 8.0);
}

}  // namespace
}  // namespace myoid::fit
