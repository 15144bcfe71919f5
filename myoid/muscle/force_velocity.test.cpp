#include "myoid/muscle/force_velocity.h"

#include <cmath>

#include <ceres/jet.h>
#include <gtest/gtest.h>

namespace myoid::muscle {
namespace {

constexpr VelocityHyperbola<double> kPaper{
    .concentric_curvature = 0.3, .eccentric_curvature_product = 0.12, .eccentric_plateau = 1.3};
constexpr VelocityHyperbola<double> kInvertible{.concentric_curvature = 0.3,
                                                .eccentric_curvature_product = 0.12,
                                                .eccentric_plateau = 1.3,
                                                .tangent_from = 0.95,
                                                .tangent_below = true};

TEST(ForceVelocity, HasTheValuesWorkedOutByHand) {
  const auto at = [](double v) { return force_velocity(kPaper, v).value; };
  EXPECT_EQ(at(-1.0), 0.0);
  EXPECT_EQ(at(-1.25), 0.0);
  EXPECT_EQ(at(0.0), 1.0);
  EXPECT_NEAR(at(-0.1), 0.3 * 0.9 / 0.4, 1e-15);
  EXPECT_NEAR(at(-0.3), 0.3 * 0.7 / 0.6, 1e-15);
  EXPECT_NEAR(at(0.05), 0.185 / 0.17, 1e-15);
  EXPECT_NEAR(at(0.1), 0.25 / 0.22, 1e-15);
  EXPECT_NEAR(at(0.2), 0.38 / 0.32, 1e-15);
  EXPECT_NEAR(at(1e9), 1.3, 1e-9);
}

TEST(ForceVelocity, NeverDecreases) {
  double last = 0.0;
  for (double v = -1.2; v < 4.0; v += 0.01) {
    const double f = force_velocity(kPaper, v).value;
    EXPECT_GE(f, last);
    last = f;
  }
}

TEST(ForceVelocity, TheSlopeRatioIsThatOfTheTwoOneSidedSlopes) {
  const double h = 1e-7;
  const double right = (force_velocity(kPaper, h).value - 1.0) / h;
  const double left = (1.0 - force_velocity(kPaper, -h).value) / h;
  EXPECT_NEAR(slope_ratio(kPaper), right / left, 1e-5);  // one-sided: truncation of order h f''
  EXPECT_NEAR(slope_ratio(kPaper), 2.5 / (13.0 / 3.0), 1e-12);
  EXPECT_NEAR(curvature_product_from_slope_ratio(slope_ratio(kPaper), 0.3, 1.3), 0.12, 1e-14);
}

TEST(ForceVelocity, TangentsJoinWithoutAKink) {
  const double last = 0.12 * 0.95 / 0.05;
  for (const double seam : {-1.0, last}) {
    const auto before = force_velocity(kInvertible, seam * (1 - 1e-9));
    const auto after = force_velocity(kInvertible, seam * (1 + 1e-9));
    EXPECT_NEAR(before.value, after.value, 1e-8);
    EXPECT_NEAR(before.slope, after.slope, 1e-8);
  }
  EXPECT_NEAR(force_velocity(kInvertible, last).value, 1.0 + 0.95 * 0.3, 1e-15);
}

TEST(ForceVelocity, SlopeIsTheDerivative) {
  using Jet = ceres::Jet<double, 1>;
  VelocityHyperbola<Jet> h{Jet(0.3), Jet(0.12), Jet(1.3), Jet(0.95), true};
  for (const double v : {-1.5, -0.6, -0.01, 0.02, 0.8, 3.0}) {
    const auto point = force_velocity(h, Jet(v, 0));
    EXPECT_NEAR(point.value.v[0], point.slope, 1e-14) << v;
  }
}

TEST(ForceVelocity, SolvingFindsTheVelocityOnEveryBranch) {
  for (const auto& h : {kPaper, kInvertible}) {
    for (const double strength : {1e-9, 1e-3, 0.4, 1.0}) {
      for (const double damping : {1e-6, 0.1, 3.0}) {
        for (double v = -4.0; v < 9.0; v += 0.0719) {
          const double force = strength * force_velocity(h, v).value + damping * v;
          const double found = solve_velocity(h, strength, damping, force);
          const double back = strength * force_velocity(h, found).value + damping * found;
          EXPECT_NEAR(back, force, 4e-15 * (1.0 + std::abs(force))) << strength << ' ' << damping << ' ' << v;
        }
      }
    }
  }
}

TEST(ForceVelocity, WithoutDampingTheTangentsCarryAnyForce) {
  for (double force = -3.0; force < 4.0; force += 0.0371) {
    const double v = solve_velocity(kInvertible, 0.7, 0.0, force);
    EXPECT_NEAR(0.7 * force_velocity(kInvertible, v).value, force, 1e-14);
  }
}

}  // namespace
}  // namespace myoid::muscle
