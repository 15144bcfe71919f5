#include "myoid/study/phases/moving_phases.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/gain_blocks.h"

namespace myoid::study {
namespace {

using test::gain_blocks;

std::vector<PhaseKind> kinds(const std::vector<BlockPhase>& phases) {
  std::vector<PhaseKind> result;
  for (const BlockPhase& p : phases) result.push_back(p.phase.kind);
  return result;
}
using Kinds = std::vector<PhaseKind>;
constexpr PhaseKind kRegular = PhaseKind::regular, kTired = PhaseKind::fatigued, kWarmUp = PhaseKind::warm_up,
                    kChanged = PhaseKind::changed;

TEST(MovingPhases, NeedEightBlocksWhoseTorquePerEmgIsKnown) {
  EXPECT_TRUE(moving_phases(gain_blocks({{7, 100, 100}})).empty());
  EXPECT_EQ(kinds(moving_phases(gain_blocks({{8, 100, 100}}))), Kinds{kRegular});
  std::vector<Block> unknown = gain_blocks({{20, 100, 100}});
  unknown[3].gain = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(moving_phases(unknown).empty());
}

TEST(MovingPhases, LessTorqueAndFrequencyLaterIsFatigueAndBeforeAWarmUp) {
  const auto tired = moving_phases(gain_blocks({{20, 100, 100}, {10, 80, 85}}));
  ASSERT_EQ(kinds(tired), (Kinds{kRegular, kTired}));
  EXPECT_EQ(tired[1].first, 20U);
  EXPECT_EQ(tired[1].last, 30U);
  EXPECT_NEAR(tired[1].phase.gain.value_or(0), 0.8, 0.02);
  EXPECT_NEAR(tired[1].phase.frequency.value_or(0), 0.85, 0.02);
  EXPECT_EQ(kinds(moving_phases(gain_blocks({{10, 80, 100}, {20, 100, 100}}))), (Kinds{kWarmUp, kRegular}));
  // A warm-up may be as little as 6 %, fatigue not.
  EXPECT_EQ(kinds(moving_phases(gain_blocks({{10, 92, 100}, {20, 100, 100}}))), (Kinds{kWarmUp, kRegular}));
  EXPECT_EQ(kinds(moving_phases(gain_blocks({{20, 100, 100}, {10, 92, 85}}))), (Kinds{kRegular, kRegular}));
  // More torque for the same EMG at first is none either unless it is a tenth.
  EXPECT_EQ(kinds(moving_phases(gain_blocks({{10, 108, 100}, {20, 100, 100}}))), (Kinds{kRegular, kRegular}));
  EXPECT_EQ(kinds(moving_phases(gain_blocks({{10, 115, 100}, {20, 100, 100}}))), (Kinds{kWarmUp, kRegular}));
  // Three fresh blocks with more torque and higher frequencies are no warm-up.
  EXPECT_EQ(kinds(moving_phases(gain_blocks({{3, 125, 112}, {20, 100, 100}}))), (Kinds{kRegular, kRegular}));
}

TEST(MovingPhases, WhatNeitherExplainsIsChanged) {
  // The frequency did not fall; another speed; more torque later on.
  EXPECT_EQ(kinds(moving_phases(gain_blocks({{20, 100, 100}, {10, 80, 100}}))), (Kinds{kRegular, kChanged}));
  EXPECT_EQ(kinds(moving_phases(gain_blocks({{20, 100, 100}, {10, 80, 85, 0, 4.0}}))), (Kinds{kRegular, kChanged}));
  EXPECT_EQ(kinds(moving_phases(gain_blocks({{20, 100, 100}, {10, 125, 85}}))), (Kinds{kRegular, kChanged}));
  // A twentieth is less than frequencies vary by.
  EXPECT_EQ(kinds(moving_phases(gain_blocks({{20, 100, 100}, {10, 80, 95}}))), (Kinds{kRegular, kChanged}));
  EXPECT_EQ(kinds(moving_phases(gain_blocks({{10, 80, 100, 0, 4.0}, {20, 100, 100}}))), (Kinds{kChanged, kRegular}));
  // Too few blocks for a warm-up.
  EXPECT_EQ(kinds(moving_phases(gain_blocks({{3, 75, 100}, {20, 100, 100}}))), (Kinds{kChanged, kRegular}));
}

TEST(MovingPhases, WithoutFrequenciesTheTorqueAloneTellsFatigue) {
  std::vector<Block> some = gain_blocks({{20, 100, 100}, {10, 80, 85}});
  for (Block& b : some) b.frequency = std::numeric_limits<double>::quiet_NaN();
  const auto found = moving_phases(some);
  ASSERT_EQ(kinds(found), (Kinds{kRegular, kTired}));
  EXPECT_FALSE(found[1].phase.frequency);
  EXPECT_NE(found[1].phase.reason.find("no raw EMG"), std::string::npos);
}

TEST(MovingPhases, TiredMusclesStaySoUntilTheirTorqueIsBack) {
  const auto found = moving_phases(gain_blocks({{60, 100, 100}, {24, 70, 82}, {24, 88, 100}, {24, 105, 100}}));
  EXPECT_EQ(kinds(found), (Kinds{kRegular, kTired, kTired, kRegular}));
}

TEST(MovingPhases, LessTorqueBeforeFatigueIsItsBeginning) {
  // The frequency has begun to fall, by less than would count alone.
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto found = moving_phases(gain_blocks({{20, 100, 100}, {8, 84, 96}, {8, 70, 85}}, seed));
    seen += kinds(found) == Kinds{kRegular, kTired, kTired};
  }
  EXPECT_GE(seen, 18);
}

TEST(MovingPhases, TiringThatGoesOnBeginsWhereATenthIsLost) {
  // 1 % per block from block 10 on: a tenth is lost at block 20, wherever the change is put.
  std::vector<Block> some = gain_blocks({{10, 100, 100}, {30, 100, 100, -1.0}});
  for (std::size_t b = 10; b < some.size(); ++b) some[b].frequency -= 0.006 * static_cast<double>(b - 10);
  const auto found = moving_phases(some);
  ASSERT_GE(found.size(), 2U);
  std::size_t begin = 0;
  for (const BlockPhase& p : found) {
    if (p.phase.kind == kTired && begin == 0) begin = p.first;
  }
  EXPECT_NEAR(static_cast<double>(begin), 20.0, 4.0);
}

TEST(MovingPhases, EffortThatFadesIsAWarmUpThoughTheTorquePerEmgIsRegular) {
  std::vector<Block> some = gain_blocks({{60, 80, 100}});
  math::Random random(9, 0);
  for (std::size_t b = 0; b < some.size(); ++b)
    some[b].economy = -0.6 * std::exp(-static_cast<double>(b) / 3.0) + 0.004 * random.normal();
  const auto found = moving_phases(some);
  ASSERT_EQ(kinds(found), (Kinds{kWarmUp, kRegular}));
  // 3 ln(0.6 / 0.06) = 7 blocks until less than 6 % is left.
  EXPECT_NEAR(static_cast<double>(found[0].last), 7.0, 3.0);
  EXPECT_EQ(found[1].first, found[0].last);
  EXPECT_EQ(found[1].last, 60U);
  EXPECT_NEAR(found[0].phase.gain.value_or(0.0), 1.0, 0.05);
  // Blocks of another movement at the beginning are not counted, but lie before its end.
  for (std::size_t b = 0; b < 3; ++b) {
    some[b].speed = 0.5;
    some[b].economy = 0.5;
  }
  const auto late = moving_phases(some);
  ASSERT_FALSE(late.empty());
  EXPECT_EQ(late[0].phase.kind, kWarmUp);
  // From block 3 on 0.22 is left: 3 ln(0.22 / 0.06) = 4 blocks more.
  EXPECT_NEAR(static_cast<double>(late[0].last), 7.0, 1.5);
}

}  // namespace
}  // namespace myoid::study
