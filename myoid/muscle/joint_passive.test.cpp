#include "myoid/muscle/joint_passive.h"

#include <cmath>

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::muscle {
namespace {

TEST(JointPassive, IsTheDoubleExponentialOfTheLiterature) {
  // T = k1 exp(-k2 (q - q1)) - k3 exp(-k4 (q2 - q)) - k0 (q - q0) - b qdot
  const JointPassive<double> joint{.stiffness_nm_per_rad = 0.8,
                                   .neutral_rad = 1.3,
                                   .viscosity_nms_per_rad = 0.25,
                                   .lower_stop_torque_nm = 2.0,
                                   .lower_stop_rad = 0.2,
                                   .lower_stop_width_rad = 1.0 / 18.0,
                                   .upper_stop_torque_nm = 3.0,
                                   .upper_stop_rad = 2.4,
                                   .upper_stop_width_rad = 1.0 / 25.0};
  for (const double q : {0.1, 0.3, 1.2, 2.3, 2.5}) {
    const double expected =
        2.0 * std::exp(-18.0 * (q - 0.2)) - 3.0 * std::exp(-25.0 * (2.4 - q)) - 0.8 * (q - 1.3) - 0.25 * 1.7;
    EXPECT_NEAR(joint_passive(joint, q, 1.7).torque_nm, expected, 1e-13 * (1.0 + std::abs(expected)));
  }
}

TEST(JointPassive, ElasticTorqueIsMinusTheSlopeOfTheEnergyAndStiffnessMinusThatOfTheTorque) {
  using Jet = ceres::Jet<double, 1>;
  const JointPassive<double> elbow = elbow_passive();
  JointPassive<Jet> lifted{Jet(elbow.stiffness_nm_per_rad), Jet(elbow.neutral_rad),    Jet(elbow.viscosity_nms_per_rad),
                           Jet(elbow.lower_stop_torque_nm), Jet(elbow.lower_stop_rad), Jet(elbow.lower_stop_width_rad),
                           Jet(elbow.upper_stop_torque_nm), Jet(elbow.upper_stop_rad), Jet(elbow.upper_stop_width_rad)};
  for (const double q : {-0.05, 0.2, 1.0, 2.3, 2.6}) {
    const auto o = joint_passive(lifted, Jet(q, 0), Jet(-2.0));
    const double scale = 1.0 + std::abs(o.elastic_torque_nm.a);
    EXPECT_NEAR(o.stored_energy_j.v[0], -o.elastic_torque_nm.a, 1e-13 * scale);
    EXPECT_NEAR(o.elastic_torque_nm.v[0], -o.stiffness_nm_per_rad, 1e-13 * o.stiffness_nm_per_rad);
    EXPECT_EQ(o.viscous_power_w.a, -0.2 * 4.0);
  }
}

TEST(JointPassive, StopsPushIntoTheRangeAndAFreeJointDoesNothing) {
  EXPECT_GT(joint_passive(elbow_passive(), 0.0, 0.0).torque_nm, 20.0);
  EXPECT_LT(joint_passive(elbow_passive(), 150.0 * kDegree, 0.0).torque_nm, -20.0);
  EXPECT_NEAR(joint_passive(elbow_passive(), 80.0 * kDegree, 0.0).torque_nm, 0.0, 1e-8);
  EXPECT_EQ(joint_passive(JointPassive<double>{}, 1.0, 5.0).torque_nm, 0.0);
}

TEST(JointPassive, RefusesWhatWouldGiveEnergy) {
  JointPassive<double> joint = elbow_passive();
  joint.viscosity_nms_per_rad = -0.1;
  EXPECT_THROW(validate(joint), InvalidInput);
  joint = elbow_passive();
  joint.upper_stop_width_rad = 0.0;
  EXPECT_THROW(validate(joint), InvalidInput);
  EXPECT_NO_THROW(validate(elbow_passive()));
}

}  // namespace
}  // namespace myoid::muscle
