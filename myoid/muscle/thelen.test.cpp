#include "myoid/muscle/thelen.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::muscle {
namespace {

TEST(ThelenForceVelocity, InvertsThePublishedLawInBothBranches) {
  const ThelenParameters p{.concentric_shape = 0.3, .eccentric_plateau = 1.8};
  for (const double a : {0.05, 0.5, 1.0}) {
    for (const double v : {-0.9, -0.3, -0.01, 0.01, 0.05, 0.2}) {
      const double scaled = v * (0.25 + 0.75 * a);
      const double f = thelen_force_velocity(p, a, scaled);
      const double b = f <= 1.0 ? 1.0 + f / 0.3 : (2.0 + 2.0 / 0.3) * (1.8 - f) / 0.8;
      ASSERT_LT(f, 0.95 * 1.8);  // the published branch, not the line beyond it
      EXPECT_NEAR((0.25 + 0.75 * a) * (f - 1.0) / b, scaled, 1e-13);
    }
  }
}

TEST(ThelenForceVelocity, IsUndoneByTheFiberVelocity) {
  const ThelenParameters p{.concentric_shape = 0.3, .eccentric_plateau = 1.8};
  for (const double a : {0.05, 0.5, 1.0}) {
    for (const double f : {0.0, 0.2, 0.9, 1.0, 1.2, 1.7, 1.75, 2.5})
      EXPECT_NEAR(thelen_force_velocity(p, a, thelen_fiber_velocity(p, a, f)), f, 1e-12);
    // Below zero force the velocity goes on as the line that touches the curve there.
    EXPECT_NEAR(thelen_fiber_velocity(p, a, -0.1) - thelen_fiber_velocity(p, a, 0.0),
                -0.1 * (0.25 + 0.75 * a) * (1.0 + 1.0 / 0.3), 1e-12);
  }
}

TEST(ThelenForceVelocity, IsContinuousWhereTheLineBegins) {
  const ThelenParameters p;
  double last = thelen_force_velocity(p, 1.0, -1.2);
  for (double v = -1.2; v < 3.0; v += 1e-4) {
    const double f = thelen_force_velocity(p, 1.0, v);
    EXPECT_LT(std::abs(f - last), 2e-3);
    EXPECT_GE(f, last - 1e-15);
    last = f;
  }
}

TEST(RigidTendonFiber, KeepsItsWidth) {
  const ThelenParameters p{
      .optimal_fiber_length_m = 0.1, .tendon_slack_length_m = 0.2, .pennation_at_optimal_rad = 0.3};
  const RigidTendonFiber fiber = rigid_tendon_fiber(p, 0.31, 0.4);
  EXPECT_NEAR(fiber.fiber_length_m * std::sqrt(1.0 - fiber.cos_pennation * fiber.cos_pennation),
              0.1 * std::sin(0.3), 1e-15);
  EXPECT_NEAR(fiber.fiber_length_m * fiber.cos_pennation, 0.11, 1e-15);
  EXPECT_NEAR(fiber.fiber_velocity_mps, 0.4 * fiber.cos_pennation, 1e-15);
}

TEST(ThelenOptimalForce, IsTheMaximalForceAtOptimalLengthAndRest) {
  const ThelenParameters p{.max_isometric_force_n = 987.0};
  EXPECT_NEAR(thelen_optimal_force(p, 0.3, 0.0), 987.0, 1e-10);
}

}  // namespace
}  // namespace myoid::muscle
