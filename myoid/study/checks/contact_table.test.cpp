#include "myoid/study/checks/contact_table.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::study {
namespace {

body::LoadColumns linear(const Eigen::VectorXd& t, const Eigen::MatrixX3d& values) {
  body::LoadColumns result;
  for (Eigen::Index k = 0; k < 3; ++k) result.splines.push_back(math::Spline::interpolate(t, values.col(k), 1));
  return result;
}

/// A foot with one marker that moves at 1 m/s along x, 0.1 m above the floor, and a head 1.5 m above it. The force
/// rises from 0 to 200 N in a second, 0.05 m before the marker.
struct Step {
  body::BodyModel model;
  MarkerSeries markers;
  body::ExternalLoads loads;

  explicit Step(bool about_a_point) {
    model.bodies = {{.name = "ground"}, {.name = "foot", .mass_kg = 1.0}, {.name = "head", .mass_kg = 4.0}};
    for (const int child : {1, 2})
      model.joints.push_back({.name = "j", .class_name = "WeldJoint", .parent = 0, .child = child});
    model.markers = {{"toe", 1, Vec3::Zero()}, {"crown", 2, Vec3::Zero()}};
    model = body::finalize(std::move(model));
    const Eigen::Index n = 101;
    markers.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, 1.0);
    markers.names = {"toe", "crown"};
    markers.positions_m.resize(n, 6);
    Eigen::MatrixX3d force(n, 3), point(n, 3), moment(n, 3);
    const Vec3 middle(0.3, 0.0, 0.2);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double x = markers.time_s[i];
      markers.positions_m.row(i) << x, 0.1, 0.0, x, 1.6, 0.0;
      force.row(i) << 0.0, 200.0 * x, 0.0;
      point.row(i) << x + 0.05, 0.0, 0.0;
      moment.row(i) = (Vec3(point.row(i).transpose()) - middle).cross(Vec3(force.row(i).transpose())).transpose();
    }
    body::ExternalForce plate{.name = "plate", .body = 1};
    plate.force = linear(markers.time_s, force);
    plate.point = about_a_point ? body::LoadColumns{.splines = {}, .constant = middle} : linear(markers.time_s, point);
    if (about_a_point) plate.torque = linear(markers.time_s, moment);
    loads.forces.push_back(plate);
  }
  [[nodiscard]] ContactTable table() const { return contact_table(model, loads, {model, &markers, nullptr}); }
};

TEST(ContactTable, HasDistancesOfTheCenterOfPressureFromEachBody) {
  for (const bool about_a_point : {false, true}) {
    const ContactTable table = Step(about_a_point).table();
    ASSERT_EQ(table.forces.size(), 1U);
    EXPECT_NEAR(table.forces[0].largest_n, 200.0, 1e-9);
    ASSERT_EQ(table.frames.size(), 101U);
    // From a twentieth of the largest force on: 10 N at 0.05 s.
    EXPECT_FALSE(table.frames[4].of[0]);
    ASSERT_TRUE(table.frames[6].of[0]);
    const GroundContact& contact = *table.frames[50].of[0];
    EXPECT_NEAR((contact.center_m - Vec3(0.55, 0.0, 0.0)).norm(), 0.0, 1e-9);
    EXPECT_NEAR(contact.force_n.y(), 100.0, 1e-9);
    EXPECT_NEAR(contact.alone_m[1], std::hypot(0.05, 0.1), 1e-9);
    EXPECT_NEAR(contact.alone_m[2], std::hypot(0.05, 1.6), 1e-9);
    EXPECT_TRUE(std::isinf(contact.alone_m[0]));
    // A turn by 180 degrees brings the center to x = -0.55 m.
    EXPECT_NEAR(contact.turned_m[0], contact.alone_m[1], 1e-9);
    EXPECT_NEAR(contact.turned_m[2], std::hypot(1.05, 0.1), 1e-9);
  }
}

TEST(ContactTable, HasTheLowestPointOfEachBodyAndItsSpeed) {
  const ContactTable table = Step(false).table();
  EXPECT_TRUE(std::isinf(table.frames[0].speed_mps[1]));
  EXPECT_NEAR(table.frames[7].speed_mps[1], 1.0, 1e-9);
  ASSERT_TRUE(table.frames[7].lowest_m[2]);
  EXPECT_NEAR((*table.frames[7].lowest_m[2] - Vec3(0.07, 1.6, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_FALSE(table.frames[7].lowest_m[0]);
}

TEST(ContactTable, LeavesOutForcesInTheFrameOfABody) {
  Step step(false);
  step.loads.forces[0].point_frame = 1;
  EXPECT_TRUE(step.table().forces.empty());
}

}  // namespace
}  // namespace myoid::study
