#include "myoid/muscle/fatigue.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::muscle {
namespace {

using FatigueNow = FatigueState<double>;

/// Returns the share that stays active under an unreachable target, t -> infinity:
///   M_A = 1 / (1 + F/R + F/LD).
double sustainable_load(const FatigueRates<double>& rates) {
  return 1.0 / (1.0 + rates.fatigue_per_s / rates.recovery_per_s + rates.fatigue_per_s / rates.development_per_s);
}

TEST(Fatigue, RatesAreThePublishedOnesInEveryCase) {
  const FatigueRates<double> r{.rest_recovery_factor = 15.0};
  // Below the target with reserve: C = LD (0.5 - 0.2) = 3.
  FatigueNow d = fatigue_rate<double>(r, 0.5, {0.2, 0.7, 0.1});
  EXPECT_NEAR(d.active, 3.0 - 0.00912 * 0.2, 1e-15);
  EXPECT_NEAR(d.resting, -3.0 + 0.00094 * 0.1, 1e-15);
  EXPECT_NEAR(d.fatigued, 0.00912 * 0.2 - 0.00094 * 0.1, 1e-15);
  // Without reserve: C = LD M_R = 1.
  d = fatigue_rate<double>(r, 0.9, {0.3, 0.1, 0.6});
  EXPECT_NEAR(d.active, 1.0 - 0.00912 * 0.3, 1e-15);
  // Above the target: C = LR (0.2 - 0.3) = -1.
  d = fatigue_rate<double>(r, 0.2, {0.3, 0.6, 0.1});
  EXPECT_NEAR(d.active, -1.0 - 0.00912 * 0.3, 1e-15);
  // At rest recovery is r times faster.
  d = fatigue_rate<double>(r, 0.0, {0.0, 0.4, 0.6});
  EXPECT_NEAR(d.fatigued, -15.0 * 0.00094 * 0.6, 1e-15);
}

TEST(Fatigue, CompartmentsAlwaysAddUpToOne) {
  FatigueNow s;
  const FatigueRates<double> r;
  for (const double target : {0.8, 0.0, 1.0, 0.3, 0.9}) {
    s = step_fatigue(r, target, s, 47.3);
    EXPECT_NEAR(s.active + s.resting + s.fatigued, 1.0, 1e-11);  // 1e4 steps of round-off
    EXPECT_GE(std::min({s.active, s.resting, s.fatigued}), -1e-9);
  }
}

TEST(Fatigue, MaximalEffortSettlesWhereFatigueAndRecoveryBalance) {
  const FatigueRates<double> r;
  const FatigueNow s = step_fatigue(r, 1.0, {}, 3000.0);  // 30 times 1 / (F + R) = 99 s
  EXPECT_NEAR(s.active, sustainable_load(r), 1e-9);
  EXPECT_NEAR(r.fatigue_per_s * s.active, r.recovery_per_s * s.fatigued, 1e-11);
}

TEST(Fatigue, AHeldLoadBelowTheSustainableOneIsHeld) {
  const FatigueRates<double> r;
  const double load = 0.5 * sustainable_load(r);
  const FatigueNow s = step_fatigue(r, load, {}, 2000.0);
  // A little less than asked: C = LD (load - M_A) must replace F M_A.
  EXPECT_NEAR(s.active, load / (1.0 + r.fatigue_per_s / r.development_per_s), 1e-9);
}

TEST(Fatigue, RecoveryAtRestIsExponential) {
  const FatigueRates<double> r{.rest_recovery_factor = 15.0};
  const FatigueNow s = step_fatigue(r, 0.0, {0.0, 0.4, 0.6}, 60.0);
  EXPECT_NEAR(s.fatigued, 0.6 * std::exp(-15.0 * 0.00094 * 60.0), 1e-12);
  EXPECT_NEAR(fatigue_capacity(s), 1.0 - s.fatigued, 0.0);
}

TEST(Fatigue, StepsDoNotDependOnHowTheIntervalIsCut) {
  const FatigueRates<double> r;
  const FatigueNow whole = step_fatigue(r, 0.7, {}, 1.0);
  FatigueNow cut;
  for (int k = 0; k < 1000; ++k) cut = step_fatigue(r, 0.7, cut, 0.001);
  EXPECT_NEAR(whole.active, cut.active, 1e-8);  // (h LD)^5 / 120 = 3e-9 a step, and it decays
}

TEST(Fatigue, RefusesNegativeRatesAndUnknownNames) {
  EXPECT_THROW(validate(FatigueRates<double>{.fatigue_per_s = -1.0}), InvalidInput);
  EXPECT_THROW(validate(FatigueRates<double>{.development_per_s = 0.0}), InvalidInput);
  EXPECT_THROW(static_cast<void>(published_fatigue_rates("knee")), InvalidInput);
  for (const char* name : {"elbow", "elbow_rest", "elbow_flexor", "elbow_extensor"}) {
    EXPECT_NO_THROW(validate(published_fatigue_rates(name)));
  }
}

}  // namespace
}  // namespace myoid::muscle
