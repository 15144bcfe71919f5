#include "myoid/pipeline/movement_blocks.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "myoid/math/random.h"

namespace myoid::pipeline {
namespace {

/// A swing of `frequency_hz` for 30 s at 100 Hz; half of the torque predicted is there.
PhaseSignals swing(double frequency_hz) {
  PhaseSignals s;
  s.time_s = Eigen::VectorXd::LinSpaced(3001, 0.0, 30.0);
  s.velocity_radps = (2.0 * std::numbers::pi * frequency_hz * s.time_s.array()).cos();
  s.predicted_nm = 10.0 + 4.0 * s.velocity_radps.array();
  s.torque_nm = 0.5 * s.predicted_nm;
  s.effort_nm = 2.0 * s.predicted_nm;
  s.activation = Eigen::MatrixXd::Constant(3001, 1, 0.2);
  return s;
}

TEST(Blocks, AreWholeCyclesOfTwoSecondsOrMore) {
  // Of 0.7 Hz, 1.43 s: two cycles each; the lower turn is at three quarters of a cycle.
  const PhaseSignals s = swing(0.7);
  const auto blocks = blocks_of(s, {.first = 0, .last = 3001}, {});
  ASSERT_GE(blocks.size(), 9u);
  for (std::size_t b = 1; b < 9; ++b) {
    EXPECT_EQ(blocks[b].first, blocks[b - 1].last);
    const double cycles = 0.7 * s.time_s[blocks[b].first];
    EXPECT_NEAR(cycles - std::floor(cycles), 0.75, 0.02);
    EXPECT_NEAR(blocks[b].gain, std::log(0.5), 1e-12);
    EXPECT_NEAR(blocks[b].economy, std::log(0.25), 1e-12);
  }
}

TEST(Blocks, OfASlowMovementAreWindows) {
  const auto blocks = blocks_of(swing(0.01), {.first = 0, .last = 3001}, {});
  ASSERT_EQ(blocks.size(), 15u);
  EXPECT_EQ(blocks[7].first, 1400);
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
}  // namespace myoid::pipeline
