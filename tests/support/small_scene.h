#pragma once

#include <limits>

#include "myoid/page/scene.h"

namespace myoid::test {

/// Two bodies, two muscles (one with a line per frame), a marker and a measured one, in two frames.
inline page::Scene small_scene() {
  page::Scene scene;
  scene.name = "flex <slow>";
  scene.notes = {{.says = "A note."}};
  scene.bodies = {{.name = "ground"},
                  {.name = "forearm",
                   .mass_kg = 1.5,
                   .mass_center_m = {0.0, -0.1, 0.0},
                   .sticks_m = {{Vec3::Zero(), Vec3(0.0, -0.25, 0.0)}}}};
  scene.markers = {{"WRI", {1, {0.0, -0.25, 0.02}}}};
  scene.surfaces = {{.name = "elbow", .body = 0, .size_m = {0.02, 0.02, 0.1}}};
  scene.muscles = {
      {.name = "BIC", .max_isometric_force_n = 600.0, .points = {{0, {0.03, 0.25, 0.0}}, {1, {0.02, -0.04, 0.0}}}},
      {.name = "TRI", .max_isometric_force_n = 900.0}};
  scene.coordinates = {{"elbow", "deg"}};
  scene.time_s = Eigen::Vector2d(0.0, 0.02);
  scene.poses = {{Pose{}, Pose{}}, {Pose{}, Pose{rotation_body_xyz({0.0, 0.0, 0.5}), {}}}};
  scene.coordinate_values = Eigen::Vector2d(0.0, 28.6);
  scene.moving_muscles = {1};
  scene.lines_m = {{{Vec3(-0.03, 0.25, 0.0), Vec3(-0.02, -0.02, 0.0)}},
                   {{Vec3(-0.03, 0.25, 0.0), Vec3(-0.02, 0.0, 0.0), Vec3(-0.01, -0.02, 0.0)}}};
  Eigen::MatrixXd force(2, 2);
  force << 10.0, 20.0, 100.0, std::numeric_limits<double>::quiet_NaN();
  scene.values = {{.name = "force", .unit = "N", .top = 100.0, .value = force}};
  scene.measured_markers = {"WRI"};
  scene.measured_m.setConstant(2, 3, 0.1);
  scene.measured_m.row(1).setConstant(std::numeric_limits<double>::quiet_NaN());
  return scene;
}

}  // namespace myoid::test
