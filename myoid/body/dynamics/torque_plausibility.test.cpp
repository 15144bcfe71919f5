#include "myoid/body/dynamics/torque_plausibility.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "myoid/body/dynamics/inverse_dynamics.h"
#include "myoid/body/dynamics/joint_capacity.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/ground/core/units.h"

#include "tests/support/built_in_arm.h"

namespace myoid::body {
namespace {

TEST(UsualPeak, ASpikeIsNotTheSizeOfATorque) {
  Eigen::VectorXd torque = Eigen::VectorXd::LinSpaced(1000, -20.0, 20.0);
  torque[500] = 1e5;
  EXPECT_LT(usual_peak(torque), 20.1);
  torque.segment(0, 20).setConstant(1e5);
  EXPECT_EQ(usual_peak(torque), 1e5);
}

TimeSeries elbow_torque(double peak_nm) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(400, 0.0, 4.0);
  return {t, {{"elbow_flexion_moment", Unit::newton_meter}}, Eigen::MatrixXd(peak_nm * (2.0 * t.array()).sin())};
}

TEST(ImplausibleTorque, IsOneBeyondTheCapacityOfTheJointAndNoOther) {
  const body::BodyModel arm = test::built_in_arm();
  const double greatest_nm = joint_capacity(arm, "elbow_flexion").greatest_nm();
  EXPECT_TRUE(implausible_torques(arm, elbow_torque(0.99 * greatest_nm)).empty());
  const std::vector<Remark> found = implausible_torques(arm, elbow_torque(1.05 * greatest_nm));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, RemarkCode::torque_impossible);
  EXPECT_EQ(found[0].severity, Severity::error);
  EXPECT_EQ(found[0].about, "elbow_flexion");
  EXPECT_NEAR(*found[0].value, 1.05 * greatest_nm, 0.01 * greatest_nm);
  // The weight of the person raises the limit.
  EXPECT_TRUE(implausible_torques(arm, elbow_torque(1.05 * greatest_nm), 200.0).empty());
}

TEST(ImplausibleTorque, MassesInGramsDoNotRaiseTheirOwnLimit) {
  body::BodyModel arm = test::built_in_arm();
  for (body::Body& body : arm.bodies) {
    body.mass_kg *= 1000.0;
    body.I_BBcm_B *= 1000.0;
  }
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(401, 0.0, 4.0);
  const TimeSeries q(t, {{"elbow_flexion", Unit::radian}}, (1.2 + 0.8 * (3.0 * t.array()).sin()).matrix());
  const TimeSeries tau = inverse_dynamics(arm, body::joint_motion(arm, q).motion);
  const std::vector<Remark> found = implausible_torques(arm, tau);
  ASSERT_FALSE(found.empty());
  EXPECT_TRUE(std::ranges::any_of(found, [](const Remark& r) { return r.about == "elbow_flexion"; }));
}

}  // namespace
}  // namespace myoid::body
