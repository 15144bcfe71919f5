#include "myoid/body/dynamics/held_mass.h"

#include <gtest/gtest.h>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

body::BodyModel pendulum() {
  body::BodyModel m;
  m.bodies = {{.name = "ground"}, {.name = "forearm", .mass_kg = 1.5, .p_BBcm_B = {0.0, -0.18, 0.0}}};
  m.bodies[1].I_BBcm_B = Vec3(0.02, 0.001, 0.02).asDiagonal();
  m.coordinates = {{.name = "q", .joint = 0}};
  body::Joint joint;
  joint.name = "elbow";
  joint.child = 1;
  joint.coordinates = {0};
  joint.rotation[0] = {.axis = Vec3::UnitZ(), .coordinate = 0, .function = body::Linear{}};
  joint.rotation[1].axis = Vec3::UnitX();
  joint.rotation[2].axis = Vec3::UnitY();
  joint.translation[0].axis = Vec3::UnitX();
  joint.translation[1].axis = Vec3::UnitY();
  joint.translation[2].axis = Vec3::UnitZ();
  m.joints = {joint};
  return body::finalize(m);
}

// T = (I + m c^2 + m_p d^2) qddot + (m c + m_p d) g sin q: the closed form of a physical pendulum.
TEST(WithHeldMass, AddsTheTorqueOfAPointMassOnAPendulum) {
  const double held_kg = 2.0;
  const double d_m = 0.35;
  const body::BodyModel loaded = with_held_mass(pendulum(), "forearm", {0.0, -d_m, 0.0}, held_kg);
  const double q = 0.7;
  const double qddot = 3.0;
  body::BodyState state = body::make_state(loaded);
  const Eigen::VectorXd tau =
      body::inverse_dynamics(loaded, Eigen::VectorXd::Constant(1, q), Eigen::VectorXd::Constant(1, 1.2),
                             Eigen::VectorXd::Constant(1, qddot), {}, state);
  const double inertia = 0.02 + 1.5 * 0.18 * 0.18 + held_kg * d_m * d_m;
  const double expected = inertia * qddot + (1.5 * 0.18 + held_kg * d_m) * kStandardGravity * std::sin(q);
  EXPECT_NEAR(tau[0], expected, 1e-13 * expected * 10.0);  // round-off of some twenty products
}

TEST(WithHeldMass, RefusesABodyThatIsNotThere) {
  EXPECT_THROW((void)with_held_mass(pendulum(), "hand", Vec3::Zero(), 1.0), ModelError);
}

}  // namespace
}  // namespace myoid::body
