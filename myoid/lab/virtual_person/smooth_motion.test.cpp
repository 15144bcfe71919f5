#include "myoid/lab/virtual_person/smooth_motion.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"

namespace myoid::lab {
namespace {

// Differences of step h = 1e-4 s: truncation h^2/6 |f'''| (up to about 1e3 here: 2e-6), round-off
// 1e-16/h and, for the second, of the *first* derivative.
constexpr double kStep_s = 1e-4;
constexpr double kTolerance = 1e-5;

template <typename Curve>
void expect_derivatives(const Curve& curve, double from_s, double to_s) {
  for (double t = from_s; t < to_s; t += 0.0371) {
    const Moment before = curve(t - kStep_s);
    const Moment after = curve(t + kStep_s);
    const Moment here = curve(t);
    EXPECT_NEAR((after.value - before.value) / (2 * kStep_s), here.first, kTolerance) << t;
    EXPECT_NEAR((after.first - before.first) / (2 * kStep_s), here.second, kTolerance) << t;
  }
}

TEST(SmoothStep, RisesFromZeroToOneThroughOneHalf) {
  EXPECT_EQ(smooth_step(0.9, 1.0, 2.0).value, 0.0);
  EXPECT_EQ(smooth_step(2.0, 1.0, 2.0).value, 0.5);
  EXPECT_EQ(smooth_step(3.1, 1.0, 2.0).value, 1.0);
}

TEST(SmoothStep, DerivativesAreThoseOfDifferences) {
  expect_derivatives([](double t) { return smooth_step(t, 0.3, 1.7); }, 0.0, 2.5);
}

TEST(SmoothRamp, IsTheIntegralOfTheStep) {
  expect_derivatives([](double t) { return smooth_ramp(t, 0.3, 1.7); }, 0.0, 2.5);
  EXPECT_NEAR(smooth_ramp(5.0, 0.3, 1.7).value, 5.0 - 0.3 - 0.85, 1e-15);
}

SmoothMotion swings() {
  return {.start_rad = 0.2,
          .moves = {{.start_s = 0.1, .duration_s = 0.8, .by_rad = 0.3}},
          .amplitude_rad = 0.8,
          .oscillation_start_s = 0.5,
          .frequency_hz = 1.0,
          .pace_s = 0.7,
          .cycles = 4,
          .amplitude_variation = 0.1,
          .variation_hz = 0.21,
          .variation_phase_rad = 0.4,
          .wander_rad = 0.25,
          .wander_hz = 0.23,
          .wander_phase_rad = 1.1};
}

TEST(SmoothMotion, DerivativesAreThoseOfDifferences) {
  // Third derivatives reach A (2 pi)^3 = 200 rad/s^3.
  expect_derivatives(swings(), 0.0, 6.0);
}

TEST(SmoothMotion, BeginsAndEndsAtRest) {
  const SmoothMotion motion = swings();
  EXPECT_DOUBLE_EQ(motion.end_s(), 0.5 + 0.7 + 4.0);
  for (const double t : {-1.0, 0.1, motion.end_s(), motion.end_s() + 1.0}) {
    EXPECT_NEAR(motion(t).first, 0.0, 1e-12) << t;
    EXPECT_NEAR(motion(t).second, 0.0, 1e-10) << t;
  }
  EXPECT_NEAR(motion(motion.end_s()).value, 0.5, 1e-12);
}

TEST(SmoothMotion, SwingsAtTheFrequencyAskedFor) {
  SmoothMotion motion = swings();
  motion.moves.clear();
  motion.amplitude_variation = 0.0;
  motion.wander_rad = 0.0;
  // At full pace a period later is the same angle.
  EXPECT_NEAR(motion(2.0).value, motion(3.0).value, 1e-12);
  double highest = 0.0;
  for (double t = 0.0; t < 6.0; t += 0.001) highest = std::max(highest, motion(t).value);
  EXPECT_NEAR(highest, 0.2 + 1.6, 1e-5);  // 0.5 ms off the peak: A (2 pi)^2 (5e-4)^2 / 2 = 4e-6
}

}  // namespace
}  // namespace myoid::lab
