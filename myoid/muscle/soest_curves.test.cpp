#include "myoid/muscle/soest_curves.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::muscle {
namespace {

TEST(SoestCurves, TheForceLengthCurveIsAParabolaWithExponentialTails) {
  EXPECT_EQ(soest_force_length(1.0, 0.56).value, 1.0);
  EXPECT_NEAR(soest_force_length(1.28, 0.56).value, 0.75, 1e-15);  // half of the half width
  // At x = sqrt(0.9) the parabola is 0.1; its slope there, -2 sqrt(0.9) / w, is the tail's.
  const double join = 1.0 - 0.5 * std::sqrt(0.9);
  constexpr double h = 1e-7;
  const auto above = soest_force_length(join + h, 0.5), below = soest_force_length(join - h, 0.5);
  EXPECT_NEAR(above.value, below.value, 1e-6);
  EXPECT_NEAR(above.slope, 4.0 * std::sqrt(0.9), 1e-5);
  EXPECT_NEAR(below.slope, above.slope, 1e-4);
  EXPECT_GT(soest_force_length(2.5, 0.5).value, 0.0);
}

/// Hill's equation as Reuvers & Kistemaker write it: the velocity [v_max] of a fiber that pulls with `force` [F_max].
double published_velocity(double force, double q, double l, double f, double a, double b) {
  const double scaled_b = b / (1.0 + std::exp(-22.0 * (q - (std::log(1.0 / 0.1 - 1.0) + 0.005 * 22.0) / 22.0)));
  const double scaled_a = l > 1.0 ? a * f : a;
  if (force <= q * f) return scaled_b * (force - q * f) / (force + q * scaled_a);
  // The slanted hyperbola of lengthening.
  constexpr double kAsymptote = 1.5, kSlopeRatio = 2.0;
  const double line = kSlopeRatio * 0.005 * 0.0975 * (1.0 + a) / (0.1 * b);
  const double rest = q * (f + scaled_a) / scaled_b * kSlopeRatio;
  const double rise = f * q * (kAsymptote - 1.0);
  const double p1 = -rise / (line - rest), p2 = rise * rise / (line - rest), p3 = -kAsymptote * f * q, p4 = -line;
  const double root = std::sqrt(force * force - 2.0 * force * p1 * p4 + 2.0 * force * p3 + p1 * p1 * p4 * p4 -
                                2.0 * p1 * p3 * p4 + p3 * p3 + 4.0 * p2 * p4);
  return -(force + p3 + p1 * p4 + root) / (2.0 * p4);
}

TEST(SoestCurves, TheVelocityIsThePublishedOneAtEveryActivationAndLength) {
  constexpr double kA = 0.2;  // b = a v_max / F_max: 0.2 v_max
  for (const double q : {0.05, 0.4, 0.99}) {
    for (const double l : {0.75, 1.0, 1.2}) {
      const double f = soest_force_length(l, 0.5).value;
      const VelocityHyperbola<double> h = soest_hyperbola(kA, 1.5, q, l, f);
      for (const double share : {0.1, 0.6, 0.99, 1.2, 1.45, 1.6}) {
        const double force = share * q * f;
        const double v = published_velocity(force, q, l, f, kA, kA);
        // The quadratic's root cancels at small velocities: 1e-10 of v_max.
        EXPECT_NEAR(solve_velocity(h, q * f, 0.0, force), v, 1e-10) << q << " " << l << " " << share;
        EXPECT_NEAR(q * f * force_velocity(h, v).value, force, 1e-9);
      }
    }
  }
}

TEST(SoestCurves, TheGreatestSpeedFallsBelowTheOptimalLengthOnly) {
  const double short_f = 0.64, long_f = 0.64;
  const double full = soest_hyperbola(0.2, 1.5, 1.0, 1.0, 1.0).zero;
  EXPECT_NEAR(soest_hyperbola(0.2, 1.5, 1.0, 0.7, short_f).zero, 0.64 * full, 1e-15);
  EXPECT_EQ(soest_hyperbola(0.2, 1.5, 1.0, 1.3, long_f).zero, full);
}

TEST(SoestCurves, SpringsAreParabolasAboveTheirSlackLengths) {
  const SoestPassive<double> passive(0.6, 1.1);
  EXPECT_EQ(passive(1.05).value, 0.0);
  EXPECT_NEAR(passive(1.6).value, 1.0, 1e-15);
  EXPECT_NEAR(passive(1.35).value, 0.25, 1e-15);
  EXPECT_NEAR(soest_tendon(0.02, 0.04).value, 0.25, 1e-15);
}

}  // namespace
}  // namespace myoid::muscle
