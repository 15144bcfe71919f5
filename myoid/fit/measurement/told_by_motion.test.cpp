#include "myoid/fit/measurement/told_by_motion.h"

#include <gtest/gtest.h>

#include "tests/support/swing.h"

namespace myoid::fit {
namespace {

using test::swing;

// The torques at three held angles lie on a line, as those of a spring do; each is an effort.
TEST(ToldByMotion, SaysNothingOfEffortsAtHeldAngles) {
  StudyData data;
  for (const double angle : {0.2, 0.6, 1.0}) {
    TrialData trial = swing(0.0);
    trial.angle_rad.setConstant(angle);
    trial.velocity_radps.setZero();
    trial.acceleration_radps2.setZero();
    trial.torque_nm.setConstant(50.0 - 10.0 * angle);
    data.trials.push_back(trial);
  }
  EXPECT_FALSE(told_by_motion_alone(data));
}

TEST(ToldByMotion, IsTheShareOfASpringAndAnInertia) {
  StudyData data;
  data.trials = {swing(0.0), swing(0.0)};
  EXPECT_NEAR(*told_by_motion_alone(data), 1.0, 1e-9);
  // An effort whose frequency the motion does not have: its variance is what is left.
  data.trials = {swing(2.0)};
  const Eigen::ArrayXd y = data.trials[0].torque_nm.array();
  const double all = (y - y.mean()).square().mean();
  EXPECT_NEAR(*told_by_motion_alone(data), 1.0 - 2.0 / all, 0.02);
}

TEST(ToldByMotion, TakesTheJointOfWhichTheMotionTellsLeast) {
  StudyData data;
  data.trials = {swing(0.0)};
  const TrialData other = swing(2.0);
  data.trials[0].more_joints.push_back({"knee",
                                        other.torque_nm,
                                        other.moment_arm_m,
                                        other.angle_rad,
                                        other.velocity_radps,
                                        other.acceleration_radps2,
                                        {}});
  StudyData alone;
  alone.trials = {other};
  EXPECT_NEAR(*told_by_motion_alone(data), *told_by_motion_alone(alone), 1e-12);
}

TEST(ToldByMotion, IsUnknownWithoutMotionAndLeavesOutTrialsThatAreNotFitted) {
  StudyData data;
  data.trials = {swing(0.0), swing(5.0)};
  data.trials[1].calibration = false;
  EXPECT_NEAR(*told_by_motion_alone(data), 1.0, 1e-9);
  data.trials[0].angle_rad.resize(0);
  EXPECT_FALSE(told_by_motion_alone(data));
}

}  // namespace
}  // namespace myoid::fit
