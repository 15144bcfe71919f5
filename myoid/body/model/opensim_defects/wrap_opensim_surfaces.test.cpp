#include "myoid/body/model/opensim_defects/wrap_opensim_surfaces.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/model/opensim_defects/wrap_opensim.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

/// Straight pieces and arc between two points at distance d from the middle of a circle of radius
/// r, seen from there under the angle phi.
double round_circle(double r, double d, double phi) {
  return 2.0 * std::sqrt(d * d - r * r) + r * (phi - 2.0 * std::acos(r / d));
}

double length(const Vec3& p, const Vec3& q, const OpenSimContact& c) {
  return (c.first_W - p).norm() + c.arc_length_m + (q - c.second_W).norm();
}

const Vec3 kP(0.1, 0.01, 0.0), kQ(-0.1, 0.01, 0.0);
const double kApart = std::hypot(0.1, 0.01);
const double kAngle = kPi - 2.0 * std::atan(0.1);

TEST(OpenSimContact, AcrossACylinderTheWayIsThatRoundACircle) {
  const CylinderShape cylinder{0.04, 1.0};
  const OpenSimContact c = opensim_cylinder_contact(cylinder, Side(0), kP, kQ, true, kOpenSim452);
  ASSERT_TRUE(c.has_points);
  EXPECT_EQ(c.action, WrapAction::mandatory);
  EXPECT_NEAR(length(kP, kQ, c), round_circle(0.04, kApart, kAngle), 1e-14);
  // On the other side it is longer.
  const OpenSimContact below = opensim_cylinder_contact(cylinder, Side(-2), kP, kQ, true, kOpenSim452);
  EXPECT_NEAR(length(kP, kQ, below), round_circle(0.04, kApart, 2.0 * kPi - kAngle), 1e-14);
}

TEST(OpenSimContact, OverASphereTheWayIsAGreatCircle) {
  const OpenSimContact c = opensim_sphere_contact({0.04}, Side(0), kP, kQ, kOpenSim452);
  ASSERT_TRUE(c.has_points);
  EXPECT_NEAR(length(kP, kQ, c), round_circle(0.04, kApart, kAngle), 1e-14);
}

// OpenSim's chords of 1 mm are shorter than the arc by its length times (chord / r)^2 / 24.
TEST(OpenSimContact, OverARoundEllipsoidTheWayIsThatOverASphere) {
  const OpenSimContact c =
      opensim_ellipsoid_contact({Vec3::Constant(0.04)}, 0, WrapMethod::midpoint, kP, kQ, kOpenSim452);
  ASSERT_TRUE(c.has_points);
  const double way = round_circle(0.04, kApart, kAngle);
  EXPECT_NEAR(length(kP, kQ, c), way, 1.5 * c.arc_length_m * std::pow(0.001 / 0.04, 2) / 24.0 + 1e-8);
}

// Through a ring the path bends over the tube: a circle across it.
TEST(OpenSimContact, OverARingTheWayIsThatRoundItsTube) {
  const double R = 0.1, r = 0.02, d = 0.08;
  const Vec3 middle(R, 0.0, 0.0);
  // In the plane y = 0, the path from above to below through the hole's side of the tube.
  const Vec3 p = middle + d * Vec3(0.3, 0.0, 1.0).normalized();
  const Vec3 q = middle + d * Vec3(0.3, 0.0, -1.0).normalized();
  Compat exact_residual = kOpenSim452;
  exact_residual.approximate_torus = false;
  const OpenSimContact c = opensim_torus_contact({r, R}, Side(0), p, q, true, exact_residual);
  ASSERT_TRUE(c.has_points);
  const double angle = kPi + 2.0 * std::atan(0.3);  // on the hole's side
  EXPECT_NEAR(length(p, q, c), round_circle(r, d, angle), 1e-6);
}

TEST(OpenSimContact, APointInsideIsToldAsSuch) {
  WrapObject object;
  object.shape = CylinderShape{0.04, 1.0};
  EXPECT_EQ(opensim_contact(object, WrapMethod::hybrid, Vec3(0.01, 0.0, 0.0), kQ, true, kOpenSim452).action,
            WrapAction::inside);
}

}  // namespace
}  // namespace myoid::body
