#include "myoid/body/model/path_survey.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/units.h"

#include "tests/support/data_folder.h"

namespace myoid::body {
namespace {

/// A body that turns about z, and one muscle from ground to it.
BodyModel hinge(std::vector<PathPoint> points) {
  BodyModel m;
  m.bodies = {{.name = "ground"}, {.name = "arm", .mass_kg = 1.0}};
  m.coordinates = {{.name = "q", .joint = 0, .lower = -0.5, .upper = 2.0}};
  Joint joint;
  joint.name = "hinge";
  joint.child = 1;
  joint.coordinates = {0};
  joint.rotation[0] = {.axis = Vec3::UnitZ(), .coordinate = 0, .function = Linear{1.0, 0.0}};
  joint.rotation[1].axis = Vec3::UnitX();
  joint.rotation[2].axis = Vec3::UnitY();
  for (std::size_t k = 0; k < 3; ++k) joint.translation[k].axis = Vec3::Unit(static_cast<Eigen::Index>(k));
  m.joints = {joint};
  Muscle muscle;
  muscle.name = "m";
  muscle.path.points = std::move(points);
  m.muscles = {muscle};
  return finalize(m);
}

PathPoint fixed(BodyIndex body, const Vec3& p) {
  PathPoint point;
  point.name = "p";
  point.body = body;
  point.p_BP = p;
  return point;
}

TEST(FindJumps, NarrowsDownWhereAViaPointSwitchesOn) {
  // Beyond 1 rad the path goes over a point 20 mm out of its way.
  PathPoint via = fixed(0, Vec3(0.05, 0.12, 0.0));
  via.condition = PathPoint::Condition{0, 1.0, 5.0};
  const BodyModel m = hinge({fixed(0, Vec3(0.0, 0.3, 0.0)), via, fixed(1, Vec3(0.1, 0.0, 0.0))});
  const std::vector<PathJump> jumps = find_jumps(m);
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_EQ(jumps[0].muscle, 0);
  EXPECT_EQ(jumps[0].coordinate, 0);
  EXPECT_NEAR(jumps[0].at, 1.0 - 1e-5, 1e-9);  // the tolerance of OpenSim's range
  // The size: with and without the point.
  const double q = 1.0 - 1e-5;
  const Vec3 end(0.1 * std::cos(q), 0.1 * std::sin(q), 0.0);
  const double step =
      (Vec3(0.0, 0.3, 0.0) - via.p_BP).norm() + (via.p_BP - end).norm() - (Vec3(0.0, 0.3, 0.0) - end).norm();
  EXPECT_NEAR(jumps[0].length_m, step, 1e-9);
}

TEST(FindJumps, FindsNoneInAStraightMuscleOrWhereContactBeginsSmoothly) {
  EXPECT_TRUE(find_jumps(hinge({fixed(0, Vec3(0.02, 0.3, 0.0)), fixed(1, Vec3(0.1, 0, 0))})).empty());
  // From one side of the cylinder to beyond it, never across its axis.
  BodyModel pulley = hinge({fixed(0, Vec3(0.03, 0.25, 0.01)), fixed(1, Vec3(-0.05, -0.1, 0.0))});
  pulley.coordinates[0].lower = 0.4;
  pulley.coordinates[0].upper = 0.9;
  pulley.wrap_objects = {{.name = "w", .shape = CylinderShape{.radius_m = 0.02, .length_m = 1.0}}};
  pulley.muscles[0].path.wraps = {{.wrap_object = 0}};
  const auto is_wrapped = [&](double q) {
    BodyState state = make_state(pulley);
    compute_poses(pulley, Eigen::VectorXd::Constant(1, q), state);
    return compute_path(pulley, 0, state).wrapped;
  };
  EXPECT_NE(is_wrapped(0.4), is_wrapped(0.9));
  for (const PathJump& jump : find_jumps(pulley))
    ADD_FAILURE() << jump.at << " " << jump.length_m << " " << jump.moment_arm_m;
}

TEST(FindJumps, TheLengthIsAnotherOneOnEitherSide) {
  // arm26: BIClong leaves its ellipsoid with one end on the surface, in either way of computing.
  MYOID_REQUIRE_DATA(test::data_folder() / "opensim/arm26");
  BodyModel m = read_osim(test::data_folder() / "opensim/arm26/model.osim");
  std::erase_if(m.muscles, [](const Muscle& muscle) { return muscle.name != "BIClong"; });
  for (const Compat& compat : {Compat{}, kOpenSim452}) {
    m.compat = compat;
    const std::vector<PathJump> jumps = find_jumps(m, 100);
    int of_length = 0;
    for (const PathJump& jump : jumps) {
      const auto length_at = [&](double value) {
        BodyState state = make_state(m);
        Eigen::VectorXd q = m.default_q();
        q[jump.coordinate] = value;
        compute_poses(m, q, state);
        return compute_path(m, jump.muscle, state).length_m;
      };
      if (jump.length_m == 0.0) continue;
      ++of_length;
      // 2e-9 rad at arms of less than 2 m: BIClong's grows without bound before the jump.
      EXPECT_NEAR(std::abs(length_at(jump.at + 1e-9) - length_at(jump.at - 1e-9)), jump.length_m, 4e-9);
    }
    EXPECT_GE(of_length, 2);
  }
}

TEST(Describe, NamesMuscleCoordinateAndSize) {
  const BodyModel m = hinge({fixed(0, Vec3(0.02, 0.3, 0.0)), fixed(1, Vec3(0.1, 0, 0))});
  EXPECT_EQ(describe(m, {0, 0, 0.5 * kPi, 0.00125, 0.0}), "m at q = 90 deg: length jumps by 1.25 mm");
  EXPECT_EQ(describe(m, {0, 0, 0.0, 0.001, 0.02}), "m at q = 0 deg: length jumps by 1 mm, moment arm jumps by 20 mm");
}

TEST(RandomPosture, LiesInTheRangesAndDependsOnSeedAndNumberOnly) {
  BodyModel m = hinge({fixed(0, Vec3(0.02, 0.3, 0.0)), fixed(1, Vec3(0.1, 0, 0))});
  double least = 10.0;
  double most = -10.0;
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const double q = random_posture(m, 5, k)[0];
    EXPECT_EQ(q, random_posture(m, 5, k)[0]);
    least = std::min(least, q);
    most = std::max(most, q);
  }
  EXPECT_GE(least, -0.5);
  EXPECT_LE(most, 2.0);
  EXPECT_LT(least, -0.48);  // 1000 even draws leave less than 1 % at an end with 1 - 4e-5
  EXPECT_GT(most, 1.98);
  m.coordinates[0].locked = true;
  m.coordinates[0].default_value = 0.3;
  EXPECT_EQ(random_posture(m, 5, 1)[0], 0.3);
}

TEST(CompareWithOpenSim, NamesTheMusclesOfArm26WhoseWrapsDiffer) {
  MYOID_REQUIRE_DATA(test::data_folder() / "opensim/arm26");
  const BodyModel m = read_osim(test::data_folder() / "opensim/arm26/model.osim");
  const std::vector<PathDifference> differences = compare_with_opensim(m, 200);
  // BICshort has no wrap; the others go over oblique cylinders or an ellipsoid; TRIlong over two
  // objects at once, where OpenSim's stale points make millimeters.
  EXPECT_EQ(differences.size(), 5U);
  ASSERT_FALSE(differences.empty());
  EXPECT_EQ(m.muscles[static_cast<std::size_t>(differences[0].muscle)].name, "TRIlong");
  EXPECT_GT(differences[0].length_m, 2e-3);
  EXPECT_GT(differences[0].postures_above_1mm, 0);
  for (const PathDifference& d : differences) {
    EXPECT_NE(m.muscles[static_cast<std::size_t>(d.muscle)].name, "BICshort");
    EXPECT_GE(d.length_m, d.typical_length_m);
  }
}

TEST(CompareWithOpenSim, FindsNothingWithoutWraps) {
  EXPECT_TRUE(compare_with_opensim(hinge({fixed(0, Vec3(0.02, 0.3, 0.0)), fixed(1, Vec3(0.1, 0, 0))}), 50).empty());
}

}  // namespace
}  // namespace myoid::body
