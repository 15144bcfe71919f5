#include "myoid/muscle/velocity_hyperbola.h"

#include <cmath>

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "myoid/muscle/force_velocity.h"

namespace myoid::muscle {
namespace {

constexpr VelocityHyperbola<double> kPaper{
    .concentric_curvature = 0.3, .eccentric_curvature_product = 0.12, .eccentric_plateau = 1.3};
constexpr VelocityHyperbola<double> kInvertible{.concentric_curvature = 0.3,
                                                .eccentric_curvature_product = 0.12,
                                                .eccentric_plateau = 1.3,
                                                .tangent_from = 0.95,
                                                .tangent_below = true};

TEST(VelocityHyperbola, IsTheLawOfThePaperInUnitsOfItsSpeed) {
  const ForceVelocityShape<double> shape{0.8, 0.3, 0.12, 1.3};
  for (const double v : {-1.4, -1.0, -0.7, -0.1, 0.0, 0.05, 0.6, 9.0}) {
    EXPECT_NEAR(velocity_multiplier(kPaper, v).value, force_velocity(0.8 * v, shape), 1e-15) << v;
  }
}

TEST(VelocityHyperbola, TangentsJoinWithoutAKink) {
  const double last = 0.12 * 0.95 / 0.05;
  for (const double seam : {-1.0, last}) {
    const auto before = velocity_multiplier(kInvertible, seam * (1 - 1e-9));
    const auto after = velocity_multiplier(kInvertible, seam * (1 + 1e-9));
    EXPECT_NEAR(before.value, after.value, 1e-8);
    EXPECT_NEAR(before.slope, after.slope, 1e-8);
  }
  EXPECT_NEAR(velocity_multiplier(kInvertible, last).value, 1.0 + 0.95 * 0.3, 1e-15);
}

TEST(VelocityHyperbola, SlopeIsTheDerivative) {
  using Jet = ceres::Jet<double, 1>;
  VelocityHyperbola<Jet> h{Jet(0.3), Jet(0.12), Jet(1.3), Jet(0.95), true};
  for (const double v : {-1.5, -0.6, -0.01, 0.02, 0.8, 3.0}) {
    const auto point = velocity_multiplier(h, Jet(v, 0));
    EXPECT_NEAR(point.value.v[0], point.slope, 1e-14) << v;
  }
}

TEST(VelocityHyperbola, SolvingFindsTheVelocityOnEveryBranch) {
  for (const auto& h : {kPaper, kInvertible}) {
    for (const double strength : {1e-9, 1e-3, 0.4, 1.0}) {
      for (const double damping : {1e-6, 0.1, 3.0}) {
        for (double v = -4.0; v < 9.0; v += 0.0719) {
          const double force = strength * velocity_multiplier(h, v).value + damping * v;
          const double found = solve_velocity(h, strength, damping, force);
          const double back = strength * velocity_multiplier(h, found).value + damping * found;
          EXPECT_NEAR(back, force, 4e-15 * (1.0 + std::abs(force)))
              << strength << ' ' << damping << ' ' << v;
        }
      }
    }
  }
}

TEST(VelocityHyperbola, WithoutDampingTheTangentsCarryAnyForce) {
  for (double force = -3.0; force < 4.0; force += 0.0371) {
    const double v = solve_velocity(kInvertible, 0.7, 0.0, force);
    EXPECT_NEAR(0.7 * velocity_multiplier(kInvertible, v).value, force, 1e-14);
  }
}

}  // namespace
}  // namespace myoid::muscle
