#include "myoid/body/model/path_contacts.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/path_stations.h"

namespace myoid::body {
namespace {

/// A path in ground over a sphere and an oblique cylinder that follow each other without a point in between.
BodyModel two_objects() {
  BodyModel m;
  m.bodies = {{.name = "ground"}};
  m.wrap_objects = {{.name = "sphere", .X_BW = {Mat3::Identity(), Vec3(-0.04, 0.0, 0.005)}, .shape = SphereShape{0.02}},
                    {.name = "cylinder",
                     .X_BW = {rotation_body_xyz({0.3, 0.2, 0.0}), Vec3(0.05, 0.004, 0.0)},
                     .shape = CylinderShape{.radius_m = 0.02, .length_m = 1.0}}};
  Muscle muscle;
  muscle.name = "m";
  muscle.path.points = {{.name = "a", .p_BP = Vec3(-0.12, 0.005, 0.0)}, {.name = "b", .p_BP = Vec3(0.13, 0.007, 0.01)}};
  muscle.path.wraps = {{.wrap_object = 0}, {.wrap_object = 1}};
  m.muscles = {muscle};
  return finalize(m);
}

TEST(RefineContacts, ComesToRestQuadraticallyFromNearby) {
  const BodyModel m = two_objects();
  const BodyState state = [&] {
    BodyState s = make_state(m);
    compute_poses(m, Eigen::VectorXd(0), s);
    return s;
  }();
  PathWorkspace workspace;
  PathResult result;
  const MusclePath& path = m.muscles[0].path;
  result.moment_arm_m.resize(0);
  compute_exact_path({m, path, state}, workspace, result);
  ASSERT_TRUE(result.settled);
  const std::vector<PathStation> rest = workspace.stations;
  ASSERT_EQ(rest.size(), 6U);
  const auto distance = [&] {
    double greatest = 0.0;
    for (std::size_t i = 0; i < rest.size(); ++i)
      greatest = std::max(greatest, (workspace.stations[i].p_G - rest[i].p_G).norm());
    return greatest;
  };
  refine_contacts({m, path, state}, workspace);
  EXPECT_LT(distance(), 1e-13);  // stays where it rests
  for (std::size_t i = 1; i < 5; ++i) workspace.stations[i].p_G += Vec3(1e-3, -5e-4, 3e-4);
  const double first = distance();
  refine_contacts({m, path, state}, workspace);
  const double second = distance();
  refine_contacts({m, path, state}, workspace);
  const double third = distance();
  EXPECT_LT(second, 0.1 * first);
  EXPECT_LT(third, 100.0 * second * second + 1e-14);  // curvatures of 50 per m
}

TEST(AddContactMotion, IsNothingOverShortestWays) {
  const BodyModel m = two_objects();
  BodyState state = make_state(m);
  compute_poses(m, Eigen::VectorXd(0), state);
  // Bodies do not move here; what the ends' motion does through the tangent points must vanish:
  // seen by the moving point below.
  BodyModel moving = m;
  moving.bodies.push_back({.name = "slide", .mass_kg = 1.0});
  moving.coordinates = {{.name = "q", .joint = 0, .motion = MotionType::translational}};
  Joint joint;
  joint.name = "j";
  joint.child = 1;
  joint.coordinates = {0};
  for (std::size_t k = 0; k < 3; ++k) {
    joint.rotation[k].axis = Vec3::Unit(static_cast<Eigen::Index>(k));
    joint.translation[k].axis = Vec3::Unit(static_cast<Eigen::Index>(k));
  }
  joint.translation[1].coordinate = 0;
  joint.translation[1].function = Linear{1.0, 0.0};
  moving.joints = {joint};
  moving.muscles[0].path.points[1].body = 1;
  moving = finalize(moving);
  BodyState s = make_state(moving);
  compute_poses(moving, Eigen::VectorXd::Zero(1), s);
  PathWorkspace workspace;
  PathResult result;
  result.moment_arm_m = Eigen::VectorXd::Zero(1);
  compute_exact_path({moving, moving.muscles[0].path, s}, workspace, result);
  ASSERT_EQ(workspace.stations.size(), 6U);
  Eigen::VectorXd arm = Eigen::VectorXd::Zero(1);
  add_contact_motion({moving, moving.muscles[0].path, s}, workspace.stations, arm);
  EXPECT_LT(std::abs(arm[0]), 1e-12);
  EXPECT_GT(std::abs(result.moment_arm_m[0]), 1e-3);
}

}  // namespace
}  // namespace myoid::body
