#include "myoid/run/trial_result.h"

#include <gtest/gtest.h>

namespace myoid::run {
namespace {

TEST(TrialResult, HasMotionUnlessItHasNoneOrItsComputationFailed) {
  TrialResult trial;
  EXPECT_FALSE(trial.has_motion());
  trial.motion.joints.q =
      TimeSeries(Eigen::Vector2d(0.0, 0.01), {{"elbow_flexion", Unit::radian}}, Eigen::Vector2d(0.1, 0.2));
  EXPECT_TRUE(trial.has_motion());
  EXPECT_EQ(failed_trials({trial}), 0);
  TrialResult no_forces = trial;
  no_forces.forces.failure = "the model has no muscles";
  EXPECT_FALSE(no_forces.has_motion());
  trial.motion.failure = "[ik] calibrate: no frames between 0 and 1 s";
  EXPECT_FALSE(trial.has_motion());
  EXPECT_EQ(trial.failure(), trial.motion.failure);
  EXPECT_EQ(failed_trials({trial, TrialResult{}, no_forces}), 2);
}

}  // namespace
}  // namespace myoid::run
