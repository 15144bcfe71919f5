#include "myoid/lab/virtual_person/trial_script.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"

namespace myoid::lab {
namespace {

TrialProtocol trial(TrialKind kind) {
  TrialProtocol result;
  result.name = "a";
  result.kind = kind;
  return result;
}

TEST(TrialScript, FlexionStaysBetweenItsAnglesAndRestsAtTheEnds) {
  const TrialScript script = make_script(trial(TrialKind::flexion), {}, 1);
  const double variation = script.protocol.cycles.variation;
  double low = 10.0;
  double high = -10.0;
  for (double t = 0.0; t <= script.duration_s; t += 0.01) {
    low = std::min(low, script.motion(t).value);
    high = std::max(high, script.motion(t).value);
  }
  EXPECT_NEAR(low, 0.4, 1e-3);
  EXPECT_GT(high, 0.4 + 1.6 * (1.0 - variation));
  EXPECT_LE(high, 0.4 + 1.6 * (1.0 + variation));
  EXPECT_EQ(script.duration_s, 10.0);
  EXPECT_EQ(script.motion(0.0).first, 0.0);
  EXPECT_NEAR(script.motion(script.duration_s).first, 0.0, 1e-12);
}

TEST(TrialScript, LiftsGoUpAndDownAsOftenAsAsked) {
  TrialProtocol lifts = trial(TrialKind::eccentric);
  lifts.repetitions = 2;
  lifts.rest_s = 0.5;
  const TrialScript script = make_script(lifts, {}, 1);
  EXPECT_DOUBLE_EQ(script.duration_s, 2 * (0.5 + 1.5 + 0.5 + 3.0) + 0.5);
  EXPECT_DOUBLE_EQ(script.motion(2.1).value, 2.0);
  EXPECT_NEAR(script.motion(5.6).value, 0.35, 1e-12);
  EXPECT_FALSE(script.against_dynamometer());
}

TEST(TrialScript, UnevenLiftsEndNearTheirAnglesAndTakeAboutTheirTime) {
  TrialProtocol lifts = trial(TrialKind::eccentric);
  lifts.repetitions = 20;
  const TrialScript even = make_script(lifts, {}, 1);
  const TrialScript uneven = make_script(lifts, {.irregularity = 1.0}, 1);
  // 80 durations of 10 %: 1.1 % of the whole; four of them.
  EXPECT_NEAR(uneven.duration_s / even.duration_s, 1.0, 0.045);
  EXPECT_NE(uneven.duration_s, even.duration_s);
  double low = 10.0;
  double high = -10.0;
  double jump = 0.0;
  for (double t = 0.0; t <= uneven.duration_s; t += 0.01) {
    const Moment q = uneven.motion(t);
    low = std::min(low, q.value);
    high = std::max(high, q.value);
    jump = std::max(jump, std::abs(q.first));
  }
  // Within two standard deviations of 2 degrees of the angles.
  EXPECT_NEAR(low, lifts.lift.from_rad, 4.01 * kDegree);
  EXPECT_NEAR(high, lifts.lift.to_rad, 4.01 * kDegree);
  EXPECT_GT(std::abs(high - lifts.lift.to_rad), 0.5 * kDegree);
  // The smooth step's fastest is 2.7 of the mean; uneven pieces and times add.
  EXPECT_LT(jump, 2.0 * 2.7 * (lifts.lift.to_rad - lifts.lift.from_rad) / lifts.lift.raise_s);
  EXPECT_NEAR(uneven.motion(uneven.duration_s).first, 0.0, 1e-12);
}

TEST(TrialScript, UnevenSwingsStayBetweenTheirAngles) {
  const TrialScript script = make_script(trial(TrialKind::flexion), {.irregularity = 1.0}, 1);
  double low = 10.0;
  double high = -10.0;
  for (double t = 0.0; t <= script.duration_s; t += 0.01) {
    low = std::min(low, script.motion(t).value);
    high = std::max(high, script.motion(t).value);
  }
  EXPECT_NEAR(low, 0.4, 1e-3);
  EXPECT_LE(high, 0.4 + 1.6 * (1.0 + script.protocol.cycles.variation));
  EXPECT_NEAR(script.motion(script.duration_s).first, 0.0, 1e-12);
  // The antagonist comes and goes once a cycle and never quite leaves.
  EXPECT_EQ(script.co_contraction_change.frequency_hz, 0.5);
  EXPECT_LT(script.co_contraction_change.depth, 1.0);
}

TEST(TrialScript, RampsReachTheirPeakInBothDirections) {
  TrialProtocol ramps = trial(TrialKind::isometric_ramp);
  ramps.peak = 0.6;
  const TrialScript script = make_script(ramps, {}, 1);
  ASSERT_EQ(script.efforts.size(), 2U);
  const PerMuscle up = script.prescribed_activations(1.0 + 2.0 + 0.5);
  EXPECT_DOUBLE_EQ(std::max({up[0], up[1], up[2]}), 0.6);
  EXPECT_EQ(up[kBiceps], up[kBrachialis]);  // no synergy of its own unless asked for
  EXPECT_LT(up[kTriceps], 0.15 * 1.5);
  EXPECT_GT(up[kTriceps], 0.0);
  const PerMuscle down = script.prescribed_activations(script.efforts[1].start_s + 2.5);
  EXPECT_DOUBLE_EQ(down[kTriceps], 0.6);
  EXPECT_EQ(script.prescribed_activations(script.duration_s)[kTriceps], 0.0);
  EXPECT_EQ(script.motion(3.0).first, 0.0);
}

TEST(TrialScript, TheGreatestEffortIsOneInEveryAgonist) {
  TrialProtocol mvc = trial(TrialKind::mvc);
  mvc.peak = 1.0;
  mvc.direction = Direction::flexion;
  mvc.hold_s = 3.0;
  const TrialScript script = make_script(mvc, {}, 9);
  ASSERT_EQ(script.efforts.size(), 1U);
  for (double t = 3.0; t <= 6.0; t += 0.25) {  // rest 1 s, rise 2 s, hold 3 s
    const PerMuscle a = script.prescribed_activations(t);
    EXPECT_EQ(a[kBiceps], 1.0);
    EXPECT_EQ(a[kBrachialis], 1.0);
    EXPECT_EQ(a[kBrachioradialis], 1.0);
  }
}

TEST(TrialScript, AnotherNameIsAnotherDrawAnotherTrialIsNot) {
  TrialProtocol other = trial(TrialKind::flexion);
  other.name = "b";
  const TrialScript a = make_script(trial(TrialKind::flexion), {}, 1);
  EXPECT_EQ(a.mean.brachioradialis, make_script(trial(TrialKind::flexion), {}, 1).mean.brachioradialis);
  EXPECT_NE(a.mean.brachioradialis, make_script(other, {}, 1).mean.brachioradialis);
  EXPECT_NE(a.mean.brachioradialis, make_script(trial(TrialKind::flexion), {}, 2).mean.brachioradialis);
}

}  // namespace
}  // namespace myoid::lab
