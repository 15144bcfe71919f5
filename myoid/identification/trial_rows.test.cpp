#include "myoid/identification/trial_rows.h"

#include <vector>

#include <gtest/gtest.h>

namespace myoid::identification {
namespace {

TEST(TrialRows, EveryNumberOfASampleGoesWithIt) {
  // Column c of sample i is 10 i + c; the second joint's is less by 100.
  TrialData trial;
  const Eigen::VectorXd sample = Eigen::VectorXd::LinSpaced(6, 0.0, 50.0);
  const auto of_two = [&](double more) {
    return (Eigen::MatrixXd(6, 2) << sample.array() + more, sample.array() + more + 1.0).finished();
  };
  trial.time_s = sample;
  trial.length_m = of_two(0.0);
  trial.velocity_mps = of_two(2.0);
  trial.moment_arm_m = of_two(4.0);
  trial.torque_nm = trial.angle_rad = trial.resting_nm = sample;
  JointData joint;
  joint.moment_arm_m = of_two(-100.0);
  joint.torque_nm = sample.array() - 100.0;
  trial.more_joints.push_back(joint);
  const TrialData two = at_rows(trial, {1, 4});
  for (const Eigen::Index i : {0, 1}) {
    const double t = i == 0 ? 10.0 : 40.0;
    EXPECT_EQ(two.time_s[i], t);
    EXPECT_EQ(two.length_m.row(i), Eigen::RowVector2d(t, t + 1.0));
    EXPECT_EQ(two.velocity_mps.row(i), Eigen::RowVector2d(t + 2.0, t + 3.0));
    EXPECT_EQ(two.moment_arm_m.row(i), Eigen::RowVector2d(t + 4.0, t + 5.0));
    EXPECT_EQ(Eigen::Vector3d(two.torque_nm[i], two.angle_rad[i], two.resting_nm[i]), Eigen::Vector3d::Constant(t));
    EXPECT_EQ(two.more_joints[0].moment_arm_m.row(i), Eigen::RowVector2d(t - 100.0, t - 99.0));
    EXPECT_EQ(two.more_joints[0].torque_nm[i], t - 100.0);
  }
  EXPECT_EQ(two.torque_nm.size(), 2);
  EXPECT_EQ(two.force_n.size(), 0) << "no forces were given";
}

}  // namespace
}  // namespace myoid::identification
