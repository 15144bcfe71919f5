#include "myoid/study/checks/joint_of_arms.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/elbow_study.h"
#include "tests/support/message_of.h"

namespace myoid::study {
namespace {

const TrialFiles kArmFiles{
    .activations = "a.sto", .lengths = "l.sto", .velocities = "v.sto", .moment_arms = {"r.sto"}, .torques = "id.sto"};

fit::StudyData elbow_data() { return test::elbow_study({.trials = 1, .seconds = 10.0}).data; }

TEST(JointOfArms, ReadsTheCoordinateFromTheNameThatOpenSimGives) {
  EXPECT_EQ(coordinate_in_name("out/walk_MuscleAnalysis_MomentArm_knee_angle_r.sto"), "knee_angle_r");
  EXPECT_EQ(coordinate_in_name("C:\\out\\MuscleAnalysis_MomentArm_ankle.sto"), "ankle");
  EXPECT_EQ(coordinate_in_name("MomentArm_knee/arms.sto"), "");
}

TEST(JointOfArms, TheFileOfAnotherJointOfTheTorqueFileIsRefused) {
  const std::vector<std::string> leg{"knee_angle_r_moment", "ankle_angle_r_moment"};
  const std::string knee = "x_MuscleAnalysis_MomentArm_knee_angle_r.sto";
  EXPECT_EQ(check_joint_by_name(knee, "knee_angle_r_moment", leg), "");
  EXPECT_EQ(check_joint_by_name("arms.sto", "ankle_angle_r_moment", leg), "");
  const std::string error = test::message_of([&] { (void)check_joint_by_name(knee, "ankle_angle_r_moment", leg); });
  EXPECT_NE(error.find("knee_angle_r"), std::string::npos) << error;
  EXPECT_NE(error.find("coordinate knee_angle_r"), std::string::npos) << error;
  // A torque of another name is suspicious only, a part of the name is the same joint.
  EXPECT_NE(check_joint_by_name(knee, "torque", {"torque"}), "");
  EXPECT_EQ(check_joint_by_name(knee, "knee", {"knee"}), "");
}

TEST(JointOfArms, MusclesThatTheJointDoesNotMoveAreNamed) {
  fit::StudyData data = elbow_data();
  EXPECT_TRUE(check_joint_of_arms(data, data.trials[0], kArmFiles).empty());
  data.trials[0].moment_arm_m.col(1).setConstant(5e-5);
  const std::vector<std::string> remarks = check_joint_of_arms(data, data.trials[0], kArmFiles);
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_NE(remarks[0].find(data.muscles[1].name + " stays below"), std::string::npos) << remarks[0];
  data.trials[0].moment_arm_m.setConstant(5e-5);
  EXPECT_THROW((void)check_joint_of_arms(data, data.trials[0], kArmFiles), InvalidInput);
}

TEST(JointOfArms, LengthsFollowTheAnglesByTheArmsOfTheirJointOnly) {
  // l = l(q) with r = -dl/dq = r0 + r1 q of each of two muscles, and q = 0.8 sin 3 t.
  fit::StudyData data = elbow_data();
  fit::TrialData& trial = data.trials[0];
  const Eigen::Index n = trial.time_s.size();
  const Eigen::ArrayXd q = 0.8 * (3.0 * trial.time_s.array()).sin();
  trial.angle_rad = q;
  trial.length_m.resize(n, 2);
  trial.moment_arm_m.resize(n, 2);
  for (const auto& [k, r0, r1] : {std::tuple{0, 0.04, 0.01}, std::tuple{1, -0.02, 0.005}}) {
    trial.moment_arm_m.col(k) = r0 + r1 * q;
    trial.length_m.col(k) = 0.3 - r0 * q - 0.5 * r1 * q.square();
  }
  data.muscles.resize(2);
  EXPECT_TRUE(check_joint_of_arms(data, trial, kArmFiles).empty());
  for (const auto& [factor, said] : {std::pair{-1.0, "BRA (times -1)"}, std::pair{2.0, "BRA (times 2)"}}) {
    fit::TrialData wrong = trial;
    wrong.moment_arm_m.col(1) *= factor;
    const std::vector<std::string> named = check_joint_of_arms(data, wrong, kArmFiles);
    ASSERT_EQ(named.size(), 1U);
    EXPECT_NE(named[0].find(said), std::string::npos) << named[0];
    EXPECT_EQ(named[0].find("BIC"), std::string::npos) << named[0];
  }
  fit::TrialData reversed = trial;
  reversed.angle_rad = -trial.angle_rad;
  const std::vector<std::string> sign = check_joint_of_arms(data, reversed, kArmFiles);
  ASSERT_EQ(sign.size(), 1U);
  EXPECT_NE(sign[0].find("reversed"), std::string::npos) << sign[0];
  fit::TrialData other = trial;  // the angle of a joint that moves otherwise
  other.angle_rad = 0.8 * (5.0 * trial.time_s.array()).cos();
  const std::vector<std::string> joint = check_joint_of_arms(data, other, kArmFiles);
  ASSERT_EQ(joint.size(), 1U);
  EXPECT_NE(joint[0].find("another joint"), std::string::npos) << joint[0];
}

}  // namespace
}  // namespace myoid::study
