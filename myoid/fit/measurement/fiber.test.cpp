#include "myoid/fit/measurement/fiber.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/fascicle_study.h"

namespace myoid::fit {
namespace {

MuscleValues example() {
  MuscleValues p{};
  p[kMaxForce] = 900.0;
  p[kFiberLength] = 0.08;
  p[kWidth] = 0.036;
  p[kCurvature] = 0.28;
  p[kProduct] = 0.12;
  p[kPlateau] = 1.4;
  p[kSpeed] = 0.9;
  p[kSlack] = 0.22;
  p[kPennation] = 0.2;
  p[kTendonStrain] = 0.05;
  p[kPassiveStrain] = 0.6;
  p[kPassiveShape] = 4.0;
  p[kShare] = 1.0;
  return p;
}

/// Fibers without a tendon, of the length that is told, pull as the muscle does with its tendon.
TEST(Fiber, OfItsLengthPullsAsTheMuscleWithItsTendon) {
  for (const double strain : {0.0, 0.05}) {
    for (const double length_m : {0.28, 0.3, 0.31}) {
      MuscleValues p = example();
      p[kTendonStrain] = strain;
      const double force_n = tension(0.7, length_m, 0.0, p).force_n;
      const double across = p[kFiberLength] * std::sin(p[kPennation]);
      const Fiber told = fiber(force_n, length_m, p);
      MuscleValues alone = p;
      alone[kSlack] = alone[kTendonStrain] = 0.0;
      const double along = std::sqrt(told.length_m * told.length_m - across * across);
      EXPECT_NEAR(tension(0.7, along, 0.0, alone).force_n, force_n, 1e-9 * force_n);
    }
  }
}

TEST(Fiber, IsTheRestBesideTheStretchedTendon) {
  MuscleValues p = example();
  p[kPennation] = 0.0;
  EXPECT_NEAR(fiber(400.0, 0.3, p).length_m, test::written_fiber_m(400.0, 0.3, p), 1e-15);
  EXPECT_EQ(fiber(400.0, 0.2, p).length_m, 0.0);  // shorter than the tendon
}

TEST(Fiber, DerivativesAreThoseOfDifferences) {
  const MuscleValues p = example();
  const double force_n = 350.0, length_m = 0.3;
  const Fiber at = fiber(force_n, length_m, p);
  const auto difference = [](const auto& of, double h) { return (of(h) - of(-h)) / (2.0 * h); };
  EXPECT_NEAR(at.by_force, difference([&](double h) { return fiber(force_n + h, length_m, p).length_m; }, 0.1), 1e-11);
  EXPECT_NEAR(at.by_length, difference([&](double h) { return fiber(force_n, length_m + h, p).length_m; }, 1e-5), 1e-8);
  for (int field = 0; field < kMuscleFieldCount; ++field) {
    const auto f = static_cast<std::size_t>(field);
    const double step = 1e-5 * std::max(p[f], 1e-3);
    EXPECT_NEAR(at.by_field[f],
                difference(
                    [&](double h) {
                      MuscleValues moved = p;
                      moved[f] += h;
                      return fiber(force_n, length_m, moved).length_m;
                    },
                    step),
                1e-8)
        << field;
  }
}

}  // namespace
}  // namespace myoid::fit
