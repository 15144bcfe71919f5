#include "myoid/body/simulation/arm_model.h"

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

TEST(ArmModel, HasTheLiteraturesMusclesAndTheElbowAlone) {
  const SimulationModel arm = make_arm_model();
  const auto muscles = body::arm4_muscles();
  ASSERT_EQ(arm.muscles.size(), muscles.size());
  for (std::size_t i = 0; i < muscles.size(); ++i)
    EXPECT_EQ(arm.muscles[i].parameters.hill.max_isometric_force_n, muscles[i].max_isometric_force_n);
  ASSERT_EQ(arm.body.coordinates.size(), 1u);
  EXPECT_EQ(arm.body.coordinates[0].name, "elbow_flexion");
  EXPECT_EQ(arm.joints[0].stiffness_nm_per_rad, muscle::elbow_passive().stiffness_nm_per_rad);
}

TEST(ArmModel, RequiresTheTorqueOfTheClosedFormInBothPlanes) {
  const body::PlanarElbow elbow = body::planar_elbow();
  for (const bool horizontal : {false, true}) {
    const SimulationModel arm = make_arm_model({.horizontal = horizontal, .held_mass_kg = 2.0});
    body::BodyState state = body::make_state(arm.body);
    for (const double q : {0.2, 1.1, 2.3}) {
      const auto one = [](double value) { return Eigen::VectorXd(Eigen::VectorXd::Constant(1, value)); };
      const double torque_nm = body::inverse_dynamics(arm.body, one(q), one(1.5), one(-4.0), {}, state)[0];
      EXPECT_NEAR(torque_nm, body::required_torque_nm(elbow, q, -4.0, horizontal ? 0.0 : kStandardGravity, 2.0), 1e-13);
    }
  }
}

TEST(ArmModel, AMassThatIsNoneIsRefused) { EXPECT_THROW((void)make_arm_model({.held_mass_kg = -1.0}), InvalidInput); }

}  // namespace
}  // namespace myoid::body
