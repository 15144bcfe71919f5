#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/model/wrap_surfaces.h"

namespace myoid::body {
namespace {

constexpr TorusShape kRing{.inner_radius_m = 0.01, .outer_radius_m = 0.05};

/// A path along z through the ring, at x from the ring's axis: over the tube in the plane y = 0.
double closed_form_m(double x) {
  const double r = kRing.inner_radius_m;
  const double half = 0.1;
  const double D = std::hypot(x - kRing.outer_radius_m, half);
  // On the side of the ring's middle: the angle between the ends, seen from the tube's center,
  // that opens towards the middle.
  const double opening = 2.0 * (kPi - std::atan2(half, x - kRing.outer_radius_m));
  return 2.0 * std::sqrt(D * D - r * r) + r * (opening - 2.0 * std::acos(r / D));
}

double length_m(double x) {
  const Vec3 p(x, 0.0, -0.1);
  const Vec3 q(x, 0.0, 0.1);
  const auto c = wrap_torus<double>(kRing, 0, p, q);
  if (!c) return (q - p).norm();
  return (c->first_W - p).norm() + c->arc_length_m + (q - c->second_W).norm();
}

TEST(WrapTorus, KeepsThePathOnTheMiddlesSideOfTheTube) {
  for (const double x : {0.041, 0.045, 0.0499, 0.0501, 0.055, 0.06, 0.08}) {
    EXPECT_NEAR(length_m(x), closed_form_m(x), 1e-15) << x;
    const auto c = wrap_torus<double>(kRing, 0, Vec3(x, 0.0, -0.1), Vec3(x, 0.0, 0.1));
    ASSERT_TRUE(c);
    EXPECT_LT(c->first_W.x(), kRing.outer_radius_m);
    EXPECT_NEAR(std::hypot(c->first_W.x() - kRing.outer_radius_m, c->first_W.z()), kRing.inner_radius_m, 1e-16);
  }
}

TEST(WrapTorus, IsLeftAloneInTheHole) {
  for (const double x : {0.0, 0.02, 0.0399}) EXPECT_EQ(length_m(x), 0.2) << x;
  EXPECT_NEAR(length_m(0.0401), 0.2, 1e-6) << "contact begins without a jump";
}

TEST(WrapTorus, TurnsWithThePathAboutTheRingsAxis) {
  // The same path turned about z meets the same ring.
  const Eigen::AngleAxisd turn(0.7, Vec3::UnitZ());
  const Vec3 p(0.045, 0.01, -0.08);
  const Vec3 q(0.047, -0.012, 0.09);
  const auto a = wrap_torus<double>(kRing, 0, p, q);
  const auto b = wrap_torus<double>(kRing, 0, Vec3(turn * p), Vec3(turn * q));
  ASSERT_TRUE(a);
  ASSERT_TRUE(b);
  EXPECT_LT((turn * a->first_W - b->first_W).norm(), 1e-15);
  EXPECT_NEAR(a->arc_length_m, b->arc_length_m, 1e-15);
}

TEST(WrapTorus, WithAQuadrantOnlyThatSideOfTheRingCounts) {
  const Vec3 p(0.045, 0.0, -0.1);
  const Vec3 q(0.045, 0.0, 0.1);
  EXPECT_TRUE(wrap_torus<double>(kRing, 1, p, q));
  EXPECT_FALSE(wrap_torus<double>(kRing, -1, p, q));
}

}  // namespace
}  // namespace myoid::body
