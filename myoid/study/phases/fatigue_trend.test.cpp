#include "myoid/study/phases/fatigue_trend.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "myoid/ground/math/random.h"

namespace myoid::study {
namespace {

/// Blocks of one movement; gain and frequency in per cent of the first's.
struct Part {
  int count;
  double gain, frequency;
  double slope = 0.0;  ///< Of the gain, per cent of it per block; the frequency falls by 0.6 times as much.
  double speed = 2.0;
};

std::vector<Block> blocks(const std::vector<Part>& parts, std::uint64_t seed = 4) {
  math::Random random(seed, 0);
  std::vector<Block> result;
  for (const Part& part : parts) {
    for (int i = 0; i < part.count; ++i) {
      Block block;
      block.gain = std::log(part.gain / 100.0) + 0.01 * part.slope * i + 0.02 * random.normal();
      block.frequency = std::log(part.frequency / 100.0) + 0.006 * part.slope * i + 0.01 * random.normal();
      block.speed = part.speed;
      block.torque = 10.0;
      result.push_back(block);
    }
  }
  return result;
}

TEST(FindFatigue, NeedsEightBlocksWhoseTorquePerEmgIsKnown) {
  EXPECT_FALSE(find_fatigue({}));
  EXPECT_FALSE(find_fatigue(blocks({{4, 100, 100}, {3, 60, 70}})));
  EXPECT_TRUE(find_fatigue(blocks({{4, 100, 100}, {4, 60, 70}})));
  std::vector<Block> unknown = blocks({{20, 100, 100}, {10, 80, 85}});
  unknown[3].gain = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(find_fatigue(unknown));
}

TEST(FindFatigue, IsLessTorqueAndFrequencyLater) {
  const auto found = find_fatigue(blocks({{20, 100, 100}, {10, 80, 85}}));
  ASSERT_TRUE(found);
  EXPECT_NEAR(static_cast<double>(found->first), 20.0, 1.0);
  EXPECT_NEAR(found->gain, 0.8, 0.03);
  EXPECT_NEAR(found->frequency.value_or(0.0), 0.85, 0.03);
}

TEST(FindFatigue, IsNoneWhereOneOfBothHardlyFallsOrFellBefore) {
  EXPECT_FALSE(find_fatigue(blocks({{20, 100, 100}, {10, 92, 85}})));
  EXPECT_FALSE(find_fatigue(blocks({{20, 100, 100}, {10, 80, 100}})));
  EXPECT_FALSE(find_fatigue(blocks({{20, 100, 100}, {10, 80, 95}})));
  EXPECT_FALSE(find_fatigue(blocks({{20, 100, 100}, {10, 125, 85}})));
  EXPECT_FALSE(find_fatigue(blocks({{10, 80, 100}, {20, 100, 100}})));
  // Another speed: the muscles' law may explain it.
  EXPECT_FALSE(find_fatigue(blocks({{20, 100, 100}, {10, 80, 85, 0.0, 4.0}})));
}

TEST(FindFatigue, IsRightWhenItSpeaks) {
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) alarms += find_fatigue(blocks({{40, 100, 100}}, seed)).has_value();
  EXPECT_EQ(alarms, 0);
}

TEST(FindFatigue, WithoutFrequenciesTheTorqueAloneSpeaks) {
  std::vector<Block> some = blocks({{20, 100, 100}, {10, 80, 85}});
  for (std::size_t b = 0; b < some.size(); b += 6) some[b].frequency = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(find_fatigue(some).value().frequency) << "a sixth is not known";
  for (Block& b : some) b.frequency = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(find_fatigue(some).value().frequency);
}

TEST(FindFatigue, ThatGoesOnBeginsWhereATenthIsLost) {
  // 1 % per block from block 10 on: ln(1 / 0.9) = 10.5 % is lost at block 20.5.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto found = find_fatigue(blocks({{10, 100, 100}, {30, 100, 100, -1.0}}, seed));
    ASSERT_TRUE(found) << seed;
    EXPECT_NEAR(static_cast<double>(found->first), 20.5, 3.0) << seed;
  }
}

TEST(UsualBlocks, AreThoseOfTheMediansMovement) {
  std::vector<Block> some = blocks({{9, 100, 100}});
  some[2].speed *= 2.0;
  some[5].torque /= 2.0;
  EXPECT_EQ(usual_blocks(some), (std::vector<std::size_t>{0, 1, 3, 4, 6, 7, 8}));
}

}  // namespace
}  // namespace myoid::study
