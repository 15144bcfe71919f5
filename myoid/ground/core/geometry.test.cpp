#include "myoid/ground/core/geometry.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

// Round-off of a few products of numbers of order one.
constexpr double kRoundOff = 1e-14;

TEST(Pose, InverseUndoesThePose) {
  const Pose X_AB{rotation_body_xyz({0.3, -1.1, 2.0}), {0.1, -0.2, 0.7}};
  const Vec3 p_BQ(0.4, 0.5, -0.6);
  EXPECT_LT((X_AB.inverse() * (X_AB * p_BQ) - p_BQ).norm(), kRoundOff);
}

TEST(RotationBodyXyz, TurnsAboutTheBodysOwnAxesInTurn) {
  // Rx(90 deg) first, then about the turned y axis: z of the body ends along ground -y rotated by Ry.
  const double half_pi = std::acos(0.0);
  const Mat3 R_AB = rotation_body_xyz({half_pi, half_pi, 0.0});
  // Rx Ry e_z = Rx (1,0,0) = (1,0,0)
  EXPECT_LT((R_AB * Vec3::UnitZ() - Vec3::UnitX()).norm(), kRoundOff);
  // Rx Ry e_y = Rx e_y = e_z
  EXPECT_LT((R_AB * Vec3::UnitY() - Vec3::UnitZ()).norm(), kRoundOff);
}

TEST(Skew, IsTheCrossProductAsAMatrix) {
  const Vec3 a(1.0, -2.0, 3.0);
  const Vec3 b(0.5, 4.0, -1.0);
  EXPECT_EQ((skew(a) * b), a.cross(b));
}

}  // namespace
}  // namespace myoid::inline ground
