#include "myoid/body/model/bent_rod.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::body {
namespace {

/// The direction at the end of an arc of this angle that bends towards x cos(a) + z sin(a).
Vec3 direction(double angle_rad, double azimuth_rad) {
  return {std::sin(angle_rad) * std::cos(azimuth_rad), std::cos(angle_rad),
          std::sin(angle_rad) * std::sin(azimuth_rad)};
}

// Walked along in short straight steps, each along the tangent in its middle: an error of (theta/n)^2/24 of the length.
TEST(BentRod, EndsWhereAWalkAlongTheArcEnds) {
  const double length = 0.3;
  constexpr int kSteps = 20000;
  for (const double angle : {0.0, 1e-5, 0.02, 0.0999, 0.1001, 0.7, 1.5, 2.6}) {
    Vec3 walked = Vec3::Zero();
    for (int i = 0; i < kSteps; ++i) walked += length / kSteps * direction(angle * (i + 0.5) / kSteps, 0.8);
    EXPECT_LT((bent_rod_end(length, direction(angle, 0.8)) - walked).norm(), 1e-9) << angle;
  }
}

TEST(BentRod, VelocityAndAccelerationAreTheDerivatives) {
  const double length = 0.3, h = 1e-4;
  for (const double angle : {0.0, 1e-3, 0.05, 0.0995, 0.11, 0.9, 2.0}) {
    const auto u = [&](double t) { return direction(angle + 0.7 * t + t * t, 0.8 - 0.5 * t); };
    const auto end = [&](double t) { return bent_rod_end(length, u(t)); };
    const Vec3 du = (u(h) - u(-h)) / (2.0 * h);
    const Vec3 ddu = (u(h) - 2.0 * u(0.0) + u(-h)) / (h * h);
    // Central differences: h^2 of third derivatives of size 1, and round-off over h^2.
    EXPECT_LT((bent_rod_velocity(length, u(0.0), du) - (end(h) - end(-h)) / (2.0 * h)).norm(), 1e-8) << angle;
    EXPECT_LT((bent_rod_acceleration(length, u(0.0), du, ddu) - (end(h) - 2.0 * end(0.0) + end(-h)) / (h * h)).norm(),
              1e-7)
        << angle;
  }
}

// Both ways of computing meet at 0.1 rad: over an angle this small the curves are straight.
TEST(BentRod, TheTwoWaysOfComputingMeet) {
  const Vec3 du(0.3, 0.0, 0.4), ddu(-1.0, 0.2, 0.7);
  const Vec3 below = direction(0.1 - 1e-12, 0.8), above = direction(0.1 + 1e-12, 0.8);
  EXPECT_LT((bent_rod_end(1.0, below) - bent_rod_end(1.0, above)).norm(), 1e-11);
  EXPECT_LT((bent_rod_acceleration(1.0, below, du, ddu) - bent_rod_acceleration(1.0, above, du, ddu)).norm(), 1e-10);
}

}  // namespace
}  // namespace myoid::body
