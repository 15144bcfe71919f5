#include "myoid/methods/motion_alone.h"

#include <numbers>

#include <gtest/gtest.h>

namespace myoid::identification {
namespace {

/// A swing of 1 Hz with the torque of an inertia and a spring, and one of `effort` beside it.
TrialData swing(double effort_nm) {
  constexpr Eigen::Index kCount = 400;
  TrialData trial;
  trial.name = "swing";
  trial.time_s = Eigen::VectorXd::LinSpaced(kCount, 0.0, 8.0);
  const Eigen::ArrayXd phase = 2.0 * std::numbers::pi * trial.time_s.array();
  trial.angle_rad = 1.2 + 0.8 * phase.sin();
  trial.velocity_radps = 0.8 * 2.0 * std::numbers::pi * phase.cos();
  trial.acceleration_radps2 = -0.8 * 4.0 * std::numbers::pi * std::numbers::pi * phase.sin();
  trial.torque_nm = 0.08 * trial.acceleration_radps2.array() - 0.5 * trial.angle_rad.array() +
                    effort_nm * (0.7 * phase).sin();
  trial.moment_arm_m = Eigen::MatrixXd::Constant(kCount, 1, 0.04);
  return trial;
}

bool is_warned_of(const StudyData& data) {
  IdentificationResult result;
  judge_motion_alone(data, result);
  return !result.warnings.empty();
}

// The torques at three held angles lie on a line, as those of a spring do; each is an effort.
TEST(MotionAlone, SaysNothingOfEffortsAtHeldAngles) {
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
  EXPECT_FALSE(is_warned_of(data));
}

TEST(MotionAlone, IsTheShareOfASpringAndAnInertia) {
  StudyData data;
  data.trials = {swing(0.0), swing(0.0)};
  EXPECT_NEAR(*told_by_motion_alone(data), 1.0, 1e-9);
  EXPECT_TRUE(is_warned_of(data));
  // An effort whose frequency the motion does not have: its variance is what is left.
  data.trials = {swing(2.0)};
  const Eigen::ArrayXd y = data.trials[0].torque_nm.array();
  const double all = (y - y.mean()).square().mean();
  EXPECT_NEAR(*told_by_motion_alone(data), 1.0 - 2.0 / all, 0.02);
  EXPECT_FALSE(is_warned_of(data));
}

TEST(MotionAlone, TakesTheJointOfWhichTheMotionTellsLeast) {
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

TEST(MotionAlone, IsUnknownWithoutMotionAndLeavesOutTrialsThatAreNotFitted) {
  StudyData data;
  data.trials = {swing(0.0), swing(5.0)};
  data.trials[1].calibration = false;
  EXPECT_NEAR(*told_by_motion_alone(data), 1.0, 1e-9);
  data.trials[0].angle_rad.resize(0);
  EXPECT_FALSE(told_by_motion_alone(data));
  EXPECT_FALSE(is_warned_of(data));
}

}  // namespace
}  // namespace myoid::identification
