#include "myoid/body/model/muscle_path.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/arm/planar_elbow.h"
#include "myoid/body/model/wrap_surfaces.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/recording/tables/storage_reader.h"

#include "tests/support/data_folder.h"

namespace myoid::body {
namespace {

/// A hinge about z with a cylinder of radius R on its axis, a muscle behind it from above to below.
BodyModel pulley(double radius, Quadrant quadrant) {
  BodyModel m;
  m.bodies = {{.name = "ground"}, {.name = "forearm", .mass_kg = 1.0}};
  m.coordinates = {{.name = "q", .joint = 0}};
  Joint joint;
  joint.name = "elbow";
  joint.child = 1;
  joint.coordinates = {0};
  for (std::size_t k = 0; k < 3; ++k)
    joint.rotation[k].axis = joint.translation[k].axis = Vec3::Unit(static_cast<Eigen::Index>((k + 2) % 3));
  joint.rotation[0].coordinate = 0;
  joint.rotation[0].function = Linear{};
  m.joints = {joint};
  m.wrap_objects = {{.name = "w", .quadrant = quadrant, .shape = CylinderShape{radius, 0.2}}};
  Muscle muscle;
  muscle.name = "TRI";
  muscle.path.points = {{.name = "a", .body = 0, .p_BP = {-0.025, 0.25, 0.01}},
                        {.name = "b", .body = 1, .p_BP = {-0.03, -0.05, -0.01}}};
  muscle.path.wraps = {{.wrap_object = 0}};
  m.muscles = {muscle};
  return finalize(m);
}

PathResult path_at(const BodyModel& m, double q, double qdot = 0.0) {
  BodyState state = make_state(m);
  compute_poses(m, Eigen::VectorXd::Constant(1, q), state);
  compute_velocities(m, Eigen::VectorXd::Constant(1, qdot), state);
  return compute_path(m, 0, state);
}

TEST(MusclePath, AroundACylinderOnTheAxisTheMomentArmIsItsRadius) {
  // Out of the plane the helix tilts: r = -R cos(tilt), with tan(tilt) = dz / planar length.
  const BodyModel m = pulley(0.02, -1);
  for (const double q : {0.5, 1.2, 2.0}) {
    const PathResult p = path_at(m, q);
    ASSERT_TRUE(p.wrapped);
    const double planar = std::sqrt(p.length_m * p.length_m - 0.02 * 0.02);
    EXPECT_NEAR(p.moment_arm_m[0], -0.02 * planar / p.length_m, 1e-14);
  }
}

TEST(MusclePath, TheMomentArmIsMinusTheDerivativeOfTheLength) {
  const BodyModel m = pulley(0.02, -1);
  const double h = 1e-6;
  for (const double q : {0.4, 0.9, 1.7}) {
    EXPECT_NEAR(path_at(m, q).moment_arm_m[0], -(path_at(m, q + h).length_m - path_at(m, q - h).length_m) / (2.0 * h),
                1e-9);
  }
}

TEST(MusclePath, TheLengthIsContinuousWhereThePathLeavesTheCylinder) {
  const BodyModel m = pulley(0.02, 0);
  double last = path_at(m, -0.6).length_m;
  bool touched = false;
  bool free = false;
  for (double q = -0.6; q < 1.5; q += 1e-3) {
    const PathResult p = path_at(m, q);
    (p.wrapped ? touched : free) = true;
    EXPECT_LT(std::abs(p.length_m - last), 1e-4) << q;  // at most 60 mm/rad
    last = p.length_m;
  }
  EXPECT_TRUE(touched);
  EXPECT_TRUE(free);
}

TEST(MusclePath, TheSpeedIsMinusMomentArmTimesRate) {
  EXPECT_DOUBLE_EQ(path_at(pulley(0.02, -1), 1.0, 2.0).speed_mps,
                   -2.0 * path_at(pulley(0.02, -1), 1.0).moment_arm_m[0]);
}

TEST(WrapCylinder, AQuarterTurnIsMeasuredInClosedForm) {
  // From (1,1) to (-1,1) about the unit circle's... radius 1 at the origin, over the top: tangents vanish in length.
  const auto contact = wrap_cylinder<double>({.radius_m = 0.5, .length_m = 2.0}, 0, {1.0, 0.2, 0.0}, {-1.0, 0.2, 0.0});
  ASSERT_TRUE(contact);
  // Symmetric: each tangent sqrt(1.04 - 0.25); angle between = pi - 2 atan(0.2) - 2 acos(0.5/sqrt(1.04)).
  const double angle = M_PI - 2.0 * std::atan(0.2) - 2.0 * std::acos(0.5 / std::sqrt(1.04));
  EXPECT_NEAR(contact->arc_length_m, 0.5 * angle, 1e-14);
  EXPECT_NEAR(contact->first_W.x(), -contact->second_W.x(), 1e-14);
  EXPECT_GT(contact->first_W.y(), 0.0);
}

TEST(Arm4, TheModelFileHasTheClosedFormsLengthsAndMomentArms) {
  const BodyModel m = parse_osim(arm4_osim({}), "arm4.osim");
  const PlanarElbow elbow = planar_elbow({});
  const int coordinate = m.coordinate_index("elbow_flexion");
  BodyState state = make_state(m);
  for (double degrees = 2.0; degrees < 150.0; degrees += 7.0) {
    Eigen::VectorXd q = m.default_q();
    q[coordinate] = degrees * kDegree;
    compute_poses(m, q, state);
    for (int i = 0; i < 4; ++i) {
      const PathResult p = compute_path(m, m.muscle_index(elbow.muscles[static_cast<std::size_t>(i)].name), state);
      const MuscleTravel t = travel(elbow.muscles[static_cast<std::size_t>(i)], degrees * kDegree);
      EXPECT_NEAR(p.length_m, t.length_m, 1e-12) << i << " at " << degrees;
      EXPECT_NEAR(p.moment_arm_m[coordinate], t.moment_arm_m, 1e-12) << i << " at " << degrees;
    }
  }
}

TEST(Arm4, TheModelFileRequiresTheClosedFormsTorque) {
  const BodyModel m = parse_osim(arm4_osim({}), "arm4.osim");
  const PlanarElbow elbow = planar_elbow({});
  const int coordinate = m.coordinate_index("elbow_flexion");
  BodyState state = make_state(m);
  Eigen::VectorXd q = m.default_q();
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(q.size());
  for (const double angle : {0.2, 1.0, 2.2}) {
    q[coordinate] = angle;
    rate[coordinate] = 1.7;
    const Eigen::VectorXd tau = inverse_dynamics(m, q, rate, 3.0 * rate, {}, state);
    EXPECT_NEAR(tau[coordinate], required_torque_nm(elbow, angle, 5.1, kStandardGravity), 1e-9);
  }
}

TEST(MusclePath, LengthsOfArm26AreOpenSimsWhereNoEllipsoidIsTouched) {
  const auto root = test::data_folder() / "opensim/arm26";
  MYOID_REQUIRE_DATA(root);
  const BodyModel m = read_osim(root / "model.osim");
  const recording::Storage q_file = recording::read_storage(root / "opensim/smooth_Kinematics_q.sto");
  const recording::Storage outputs = recording::read_storage(root / "opensim/smooth_Outputs.sto");
  BodyState state = make_state(m);
  for (const char* name : {"TRIlat", "TRImed", "BRA"}) {
    const Eigen::VectorXd reference = outputs.data.column(std::string(name) + "|length");
    double worst = 0.0;
    for (Eigen::Index row = 0; row < q_file.data.sample_count(); ++row) {
      compute_poses(m, q_file.data.values().row(row).transpose() * kDegree, state);
      worst = std::max(worst, std::abs(compute_path(m, m.muscle_index(name), state).length_m - reference[row]));
    }
    // OpenSim's path over a cylinder is not the shortest one; 0.3 mm is what its tangents are off.
    EXPECT_LT(worst, 3e-4) << name;
  }
}

}  // namespace
}  // namespace myoid::body
