#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/model/wrap_surfaces.h"

namespace myoid::body {
namespace {

constexpr double kRadius_m = 0.03;
const Vec3 kSphereFrom(-0.08, 0.006, 0.011);
const Vec3 kSphereTo(0.07, 0.009, -0.004);

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

void expect_tangent(const Vec3& end, const Vec3& touch) {
  EXPECT_NEAR(touch.norm(), kRadius_m, 1e-16);
  EXPECT_NEAR((end - touch).dot(touch), 0.0, 1e-16);
}

TEST(WrapSphere, TheWayIsTwoTangentsAndTheArcOfAGreatCircle) {
  const auto c = wrap_sphere<double>({kRadius_m}, 0, kSphereFrom, kSphereTo);
  ASSERT_TRUE(c);
  expect_tangent(kSphereFrom, c->first_W);
  expect_tangent(kSphereTo, c->second_W);
  EXPECT_NEAR(c->arc_length_m, kRadius_m * angle_between(c->first_W, c->second_W), 1e-16);
  const Vec3 normal = kSphereFrom.cross(kSphereTo).normalized();
  EXPECT_NEAR(c->first_W.dot(normal), 0.0, 1e-17);
  EXPECT_NEAR(c->second_W.dot(normal), 0.0, 1e-17);
  // No way over another point of the surface is shorter.
  const double length = (c->first_W - kSphereFrom).norm() + c->arc_length_m + (kSphereTo - c->second_W).norm();
  EXPECT_GT(length, (kSphereTo - kSphereFrom).norm());
}

TEST(WrapSphere, TheFarWayGoesRoundTheOtherSideAndIsAsLongAsItIs) {
  // The near way lies at y > 0; the quadrant -y asks for the other.
  const auto near_way = wrap_sphere<double>({kRadius_m}, 2, kSphereFrom, kSphereTo);
  const auto far_way = wrap_sphere<double>({kRadius_m}, -2, kSphereFrom, kSphereTo);
  ASSERT_TRUE(near_way);
  ASSERT_TRUE(far_way);
  EXPECT_GT(near_way->first_W.y(), 0.0);
  EXPECT_LT(far_way->first_W.y(), 0.0);
  EXPECT_LT(far_way->second_W.y(), 0.0);
  expect_tangent(kSphereFrom, far_way->first_W);
  expect_tangent(kSphereTo, far_way->second_W);
  // OpenSim counts the far arc as negative; as long as it is, it is positive and the longer one.
  const double alpha = std::acos(kRadius_m / kSphereFrom.norm());
  const double beta = std::acos(kRadius_m / kSphereTo.norm());
  EXPECT_NEAR(far_way->arc_length_m, kRadius_m * (2.0 * kPi - angle_between(kSphereFrom, kSphereTo) - alpha - beta),
              1e-16);
  EXPECT_GT(far_way->arc_length_m, near_way->arc_length_m);
}

TEST(WrapSphere, ContactBeginsWithoutAJump) {
  // Over the top at height h: at h = R the straight line just touches.
  for (const double below : {1e-6, 1e-9}) {
    const Vec3 p(-0.08, kRadius_m - below, 0.0);
    const Vec3 q(0.07, kRadius_m - below, 0.0);
    const auto c = wrap_sphere<double>({kRadius_m}, 0, p, q);
    ASSERT_TRUE(c);
    const double length = (c->first_W - p).norm() + c->arc_length_m + (q - c->second_W).norm();
    // The excess grows with the power 3/2 of the depth.
    EXPECT_NEAR(length, 0.15, 20.0 * std::pow(below, 1.5));
  }
  EXPECT_FALSE(
      wrap_sphere<double>({kRadius_m}, 0, Vec3(-0.08, kRadius_m + 1e-9, 0.0), Vec3(0.07, kRadius_m + 1e-9, 0.0)));
}

TEST(WrapSphere, WithoutACutThereIsNoContact) {
  EXPECT_FALSE(wrap_sphere<double>({kRadius_m}, 0, kSphereFrom, Vec3(-0.05, 0.006, 0.011)));
  EXPECT_FALSE(wrap_sphere<double>({kRadius_m}, 0, Vec3(0.0, 0.01, 0.0), kSphereTo));
  EXPECT_FALSE(wrap_sphere<double>({kRadius_m}, 0, kSphereTo, -kSphereTo)) << "through the center";
}

}  // namespace
}  // namespace myoid::body
