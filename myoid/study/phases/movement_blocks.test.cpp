#include "myoid/study/phases/movement_blocks.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/ground/math/random.h"

namespace myoid::study {
namespace {

/// A swing of `frequency_hz` for 30 s at 100 Hz; half of the torque predicted is there.
PhaseSignals swing(double frequency_hz) {
  PhaseSignals s;
  s.time_s = Eigen::VectorXd::LinSpaced(3001, 0.0, 30.0);
  s.velocity_radps = (2.0 * std::numbers::pi * frequency_hz * s.time_s.array()).cos();
  s.predicted_nm = 10.0 + 4.0 * s.velocity_radps.array();
  s.torque_nm = 0.5 * s.predicted_nm;
  s.activation = Eigen::MatrixXd::Constant(3001, 1, 0.2);
  return s;
}

TEST(Blocks, AreWholeCyclesOfTwoSecondsOrMore) {
  // Of 0.7 Hz, 1.43 s: two cycles each; the lower turn is at three quarters of a cycle.
  const PhaseSignals s = swing(0.7);
  const auto blocks = blocks_of(s, {.first = 0, .last = 3001});
  ASSERT_GE(blocks.size(), 9u);
  for (std::size_t b = 1; b < 9; ++b) {
    EXPECT_EQ(blocks[b].first, blocks[b - 1].last);
    const double cycles = 0.7 * s.time_s[blocks[b].first];
    EXPECT_NEAR(cycles - std::floor(cycles), 0.75, 0.02);
    EXPECT_NEAR(blocks[b].gain, std::log(0.5), 1e-12);
  }
}

TEST(Blocks, OfASlowMovementAreWindows) {
  const auto blocks = blocks_of(swing(0.01), {.first = 0, .last = 3001});
  ASSERT_EQ(blocks.size(), 15u);
  EXPECT_EQ(blocks[7].first, 1400);
}

TEST(Blocks, AreACycleThatIsATenthTooShortAndWindowsWhereTurnsAreFarApart) {
  const auto begins = [](double period_s) {
    std::vector<double> result;
    for (const Block& b : blocks_of(swing(1.0 / period_s), {.first = 0, .last = 3001}))
      result.push_back(0.01 * static_cast<double>(b.first));
    return result;
  };
  // The lower turn is at three quarters of a cycle.
  const auto short_cycles = begins(1.9);
  EXPECT_NEAR(short_cycles[1], 1.75 * 1.9, 0.03);
  EXPECT_NEAR(short_cycles[2], 2.75 * 1.9, 0.03);
  // Of 5 s: the turn at 3.75 s is within twice 2 s, the next of 8.75 s only after a window.
  const auto slow = begins(5.0);
  EXPECT_NEAR(slow[1], 3.75, 0.03);
  EXPECT_NEAR(slow[2], 5.75, 0.03);
  EXPECT_NEAR(slow[3], 8.75, 0.03);
}

TEST(Blocks, SmallCyclesTurnToo) {
  // Every other cycle of 0.4 Hz has 0.45 times the speed, less than the root mean square.
  PhaseSignals s = swing(0.4);
  for (Eigen::Index i = 0; i < 3001; ++i) {
    const double cycles = 0.4 * s.time_s[i] + 0.25;  // from one lower turn to the next
    if (static_cast<int>(cycles) % 2 == 1) s.velocity_radps[i] *= 0.45;
  }
  const auto blocks = blocks_of(s, {.first = 0, .last = 3001});
  ASSERT_GE(blocks.size(), 10U);
  for (std::size_t b = 1; b < 10; ++b)
    EXPECT_NEAR(0.01 * static_cast<double>(blocks[b].last - blocks[b].first), 2.5, 0.05);
}

TEST(Blocks, OfAStillJointAreWindowsAndNoSlowerThanStill) {
  PhaseSignals s = swing(0.7);
  s.velocity_radps *= 0.05;
  const auto blocks = blocks_of(s, {.first = 0, .last = 3001, .still = true});
  ASSERT_EQ(blocks.size(), 15U);
  EXPECT_EQ(blocks[3].first, 600);
  EXPECT_DOUBLE_EQ(blocks[3].speed, phase_limits::kStill_radps);
}

TEST(Blocks, HaveTheRootMeanSquareOfSpeedAndTorque) {
  const auto blocks = blocks_of(swing(0.7), {.first = 0, .last = 3001});
  // Whole cycles: 1 / sqrt(2), and half of sqrt(10^2 + 4^2 / 2).
  EXPECT_NEAR(blocks[3].speed, std::sqrt(0.5), 0.01);
  EXPECT_NEAR(blocks[3].torque, 0.5 * std::sqrt(108.0), 0.05);
}

TEST(Blocks, WithoutATorqueThatGoesWithThePredictedThereIsNoGain) {
  PhaseSignals s = swing(0.7);
  s.torque_nm = -s.torque_nm;
  const auto blocks = blocks_of(s, {.first = 0, .last = 3001});
  EXPECT_TRUE(std::isnan(blocks[2].gain));
}

TEST(Blocks, FrequenciesOfChannelsThatAreKnownAtTimesAreComparable) {
  // One channel of 80 Hz, one of 120 Hz that falls silent after 15 s: nothing has changed.
  PhaseSignals s = swing(0.7);
  Eigen::MatrixXd f(30, 2);
  for (Eigen::Index w = 0; w < 30; ++w) f.row(w) << 80.0, w < 15 ? 120.0 : std::numeric_limits<double>::quiet_NaN();
  s.median_frequency_hz = {Eigen::VectorXd::LinSpaced(30, 0.5, 29.5), {{"a", Unit::hertz}, {"b", Unit::hertz}}, f};
  const auto blocks = blocks_of(s, {.first = 0, .last = 3001});
  for (const Block& b : blocks) EXPECT_NEAR(b.frequency, 0.0, 1e-12);
  // A block has the windows within it.
  f.col(0).tail(15).setConstant(40.0);
  f.col(1).setConstant(120.0);
  s.median_frequency_hz = {Eigen::VectorXd::LinSpaced(30, 0.5, 29.5), {{"a", Unit::hertz}, {"b", Unit::hertz}}, f};
  const auto fallen = blocks_of(s, {.first = 0, .last = 3001});
  EXPECT_NEAR(fallen.front().frequency - fallen.back().frequency, 0.5 * std::log(2.0), 1e-12);
}

TEST(StillAndMoving, AShortStopIsPartOfTheMovement) {
  PhaseSignals s = swing(0.7);
  for (Eigen::Index i = 0; i < 3001; ++i) {
    const double t = s.time_s[i];
    if ((t > 8.0 && t < 10.0) || (t > 20.0 && t < 25.0)) s.velocity_radps[i] = 0.0;
  }
  const auto found = still_and_moving(s);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_FALSE(found[0].still);
  EXPECT_TRUE(found[1].still);
  EXPECT_FALSE(found[2].still);
  EXPECT_EQ(found[0].first, 0);
  EXPECT_EQ(found[2].last, 3001);
  // The root mean square over 1 s is small from about half a second after the stop.
  EXPECT_NEAR(0.01 * static_cast<double>(found[1].first), 20.5, 0.2);
  EXPECT_NEAR(0.01 * static_cast<double>(found[1].last), 24.5, 0.2);
}

TEST(LongRunSd, OfIndependentValuesIsTheirs) {
  math::Random random(2, 0);
  Eigen::VectorXd x(32000);
  for (double& v : x) v = random.normal();
  EXPECT_NEAR(long_run_sd(x, 8), 1.0, 0.05);  // 4000 batches: 1.6 %
}

TEST(LongRunSd, CountsWhatHangsTogetherAndNoSlope) {
  // Neighbors that correlate by 0.6: a mean spreads by sqrt((1 + 0.6) / (1 - 0.6)) = 2 times what
  // independent ones would; batches of 16 hold 1 - 2 * 0.6 / (16 * (1 - 0.36)) = 88 % of it.
  math::Random random(1, 0);
  Eigen::VectorXd x(32000);
  double state = 0.0;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    state = 0.6 * state + 0.8 * random.normal();
    x[k] = state + 0.01 * static_cast<double>(k);
  }
  // 2000 batches: 2.5 %; second differences of batches that still correlate a little: 5 %.
  EXPECT_NEAR(long_run_sd(x, 16), 2.0 * std::sqrt(0.88), 0.12);
  EXPECT_TRUE(std::isnan(long_run_sd(x.head(40), 16)));
}

}  // namespace
}  // namespace myoid::study
