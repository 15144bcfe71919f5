#include "myoid/run/study_result.h"

#include <gtest/gtest.h>

namespace myoid {
namespace {

TEST(TrialResult, HasMotionUnlessItHasNoneOrItsComputationFailed) {
  TrialResult trial;
  EXPECT_FALSE(trial.has_motion());
  trial.motion.q = TimeSeries(Eigen::Vector2d(0.0, 0.01), {{"elbow_flexion", Unit::radian}},
                              Eigen::Vector2d(0.1, 0.2));
  EXPECT_TRUE(trial.has_motion());
  trial.failure = "[ik] calibrate: no frames between 0 and 1 s";
  EXPECT_FALSE(trial.has_motion());
}

}  // namespace
}  // namespace myoid
