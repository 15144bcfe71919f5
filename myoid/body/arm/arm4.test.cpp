#include "myoid/body/arm/arm4.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "myoid/body/model/functions.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

BodyModel read(const Arm4Options& options) { return parse_osim(arm4_osim(options), "arm4.osim"); }

/// Length of a path of fixed and sliding points, as a polygon in ground.
double polygon_m(const BodyModel& arm, const BodyState& state, const MusclePath& path) {
  double length_m = 0.0;
  Vec3 last = Vec3::Zero();
  for (std::size_t k = 0; k < path.points.size(); ++k) {
    const PathPoint& point = path.points[k];
    Vec3 p_BP = point.p_BP;
    if (point.moving) {
      for (int axis = 0; axis < 3; ++axis) {
        const int c = point.moving->coordinates[static_cast<std::size_t>(axis)];
        p_BP(axis) = evaluate(point.moving->location[static_cast<std::size_t>(axis)], c < 0 ? 0.0 : state.q(c)).value;
      }
    }
    const Vec3 p_GP = state.X_GB[static_cast<std::size_t>(point.body)] * p_BP;
    if (k > 0) length_m += (p_GP - last).norm();
    last = p_GP;
  }
  EXPECT_FALSE(arm.bodies.empty());
  return length_m;
}

TEST(Arm4, IsReadWithoutAnyRemark) {
  for (const bool rotations : {false, true}) {
    const BodyModel arm = read({.forearm_rotations = rotations});
    EXPECT_TRUE(arm.notes.empty()) << arm.notes.front().says;
    EXPECT_TRUE(arm.unsupported.empty()) << arm.unsupported.front();
    EXPECT_EQ(arm.muscles.size(), 4U);
    EXPECT_EQ(arm.coordinates.size(), rotations ? 10U : 4U);
    EXPECT_TRUE(arm.find_coordinate("elbow_flexion").has_value());
    EXPECT_TRUE(arm.find_body("forearm_hand").has_value());
  }
}

TEST(Arm4, MusclePathsHaveTheLengthsOfTheClosedForm) {
  const PlanarElbow elbow = planar_elbow();
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> angle(-1.0, 1.0);
  for (const bool rotations : {false, true}) {
    const BodyModel arm = read({.forearm_rotations = rotations});
    BodyState state = make_state(arm);
    for (double q_rad = 0.0; q_rad < 2.6; q_rad += 0.2) {
      // Whatever the other joints do: the muscles cross the elbow only.
      Eigen::VectorXd q(static_cast<Eigen::Index>(arm.coordinates.size()));
      for (double& value : q) value = angle(engine);
      q(arm.coordinate_index("elbow_flexion")) = q_rad;
      compute_poses(arm, q, state);
      state.q = q;
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(arm.muscles[i].name, elbow.muscles[i].name);
        // Round-off of lengths of a few tenths of a meter seen from meters away.
        EXPECT_NEAR(polygon_m(arm, state, arm.muscles[i].path), travel(elbow.muscles[i], q_rad).length_m, 5e-15)
            << elbow.muscles[i].name << " at " << q_rad;
      }
    }
  }
}

TEST(Arm4, InverseDynamicsIsTheClosedFormInBothPlanes) {
  const ArmOptions person{.mass_kg = 61.9, .female = true, .forearm_length_m = 0.25};
  const PlanarElbow elbow = planar_elbow(person);
  for (const bool horizontal : {false, true}) {
    for (const bool rotations : {false, true}) {
      const BodyModel arm = read({.person = person, .horizontal = horizontal, .forearm_rotations = rotations});
      BodyState state = make_state(arm);
      const int coordinate = arm.coordinate_index("elbow_flexion");
      const Eigen::VectorXd zero = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(arm.coordinates.size()));
      for (double q_rad = 0.1; q_rad < 2.5; q_rad += 0.3) {
        Eigen::VectorXd q = arm.default_q();
        Eigen::VectorXd qdot = zero;
        Eigen::VectorXd qddot = zero;
        q(coordinate) = q_rad;
        qdot(coordinate) = 3.0;  // does not matter about a fixed axis
        qddot(coordinate) = 7.0 * q_rad - 5.0;
        const double tau_nm = inverse_dynamics(arm, q, qdot, qddot, {}, state)(coordinate);
        // Round-off; the ulna of the variant adds 1e-9 kg m2.
        EXPECT_NEAR(tau_nm, required_torque_nm(elbow, q_rad, qddot(coordinate), horizontal ? 0.0 : kStandardGravity),
                    rotations ? 2e-8 : 1e-13);
      }
    }
  }
}

TEST(Arm4, MusclesCarryTheNumbersOfTheLiterature) {
  const BodyModel arm = read({});
  const auto expected = arm4_muscles();
  for (std::size_t i = 0; i < 4; ++i) {
    const MuscleProperties& p = arm.muscles[i].properties;
    EXPECT_EQ(arm.muscles[i].class_name, "Thelen2003Muscle");
    EXPECT_EQ(p.max_isometric_force_n, expected[i].max_isometric_force_n);
    EXPECT_EQ(p.optimal_fiber_length_m, expected[i].optimal_fiber_length_m);
    EXPECT_EQ(p.tendon_slack_length_m, expected[i].tendon_slack_length_m);
    EXPECT_DOUBLE_EQ(std::sqrt(p.active_shape) * p.optimal_fiber_length_m, expected[i].force_length_width_m);
    EXPECT_EQ(p.eccentric_plateau, expected[i].eccentric_plateau);
    EXPECT_EQ(p.concentric_shape, expected[i].concentric_curvature);
    EXPECT_NEAR(p.max_contraction_velocity, 10.0, 1e-14);
  }
}

TEST(Arm4, FibersAreOptimalAtTheAnglesPromised) {
  const PlanarElbow elbow = planar_elbow();
  const auto muscles = arm4_muscles();
  const std::array<double, 4> angle_deg = {85.0, 75.0, 95.0, 60.0};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(travel(elbow.muscles[i], angle_deg[i] * kDegree).length_m - muscles[i].tendon_slack_length_m,
                muscles[i].optimal_fiber_length_m, 1e-15);
    // And live: between 0.4 and 1.7 optimal lengths over the whole range.
    for (const double q_deg : {0.0, 150.0}) {
      const double ratio = (travel(elbow.muscles[i], q_deg * kDegree).length_m - muscles[i].tendon_slack_length_m) /
                           muscles[i].optimal_fiber_length_m;
      EXPECT_GT(ratio, 0.4);
      EXPECT_LT(ratio, 1.7);
    }
  }
}

TEST(Arm4, TheHandMovesForwardWhenTheHangingArmFlexesAndStaysLevelInTheOtherPlane) {
  const int hand = *read({}).find_marker("r_hand");
  for (const bool horizontal : {false, true}) {
    const BodyModel arm = read({.horizontal = horizontal});
    BodyState state = make_state(arm);
    const auto place = [&](double q_rad) {
      Eigen::VectorXd q = arm.default_q();
      q(arm.coordinate_index("elbow_flexion")) = q_rad;
      compute_poses(arm, q, state);
      const Marker& marker = arm.markers[static_cast<std::size_t>(hand)];
      return Vec3(state.X_GB[static_cast<std::size_t>(marker.body)] * marker.p_BM);
    };
    const Vec3 moved = place(0.5) - place(0.0);
    if (horizontal) {
      EXPECT_NEAR(moved.y(), 0.0, 1e-12);
      EXPECT_LT(moved.z(), -0.1);  // towards the chest: z is to the right
    } else {
      EXPECT_GT(moved.x(), 0.1);
      EXPECT_NEAR(moved.z(), 0.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace myoid::body
