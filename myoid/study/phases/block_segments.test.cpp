#include "myoid/study/phases/block_segments.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/numbers.h"

#include "tests/support/gain_blocks.h"

namespace myoid::study {
namespace {

using test::gain_blocks;

TEST(FindChanges, TellsSegmentsWithTheirMeans) {
  const BlockChanges found = find_changes(gain_blocks({{12, 100, 100}, {10, 80, 90}}));
  ASSERT_EQ(found.segments.size(), 2U);
  EXPECT_EQ(found.segments[0].last, 12U);
  EXPECT_EQ(found.segments[1].first, 12U);
  EXPECT_EQ(found.segments[1].count(), 10.0);
  // Of 10 blocks with 2 and 1 %: three standard errors.
  EXPECT_NEAR(found.segments[1].gain, std::log(0.8), 0.02);
  EXPECT_NEAR(found.segments[1].frequency, std::log(0.9), 0.01);
  EXPECT_NEAR(found.segments[1].speed, 2.0, 1e-12);
  EXPECT_NEAR(found.segments[1].torque, 10.0, 1e-12);
}

TEST(FindChanges, NoiseIsNeverTakenForLessThanAPercent) {
  std::vector<Block> same = gain_blocks({{20, 100, 100}});
  for (Block& b : same) b.gain = b.frequency = 0.0;
  const BlockChanges found = find_changes(same);
  EXPECT_DOUBLE_EQ(found.gain_sd, 0.01);
  EXPECT_DOUBLE_EQ(found.frequency_sd, 0.01);
  EXPECT_EQ(found.segments.size(), 1U);
}

TEST(FindChanges, UpToAFifthOfTheFrequenciesMayBeUnknown) {
  std::vector<Block> some = gain_blocks({{20, 100, 100}});
  for (const std::size_t b : {0U, 7U, 8U, 19U}) some[b].frequency = kNan;
  const BlockChanges found = find_changes(some);
  ASSERT_EQ(found.frequency.size(), 20);
  EXPECT_EQ(found.frequency[0], some[1].frequency);
  EXPECT_EQ(found.frequency[8], some[6].frequency);
  some[12].frequency = kNan;
  const BlockChanges unknown = find_changes(some);
  EXPECT_EQ(unknown.frequency.size(), 0);
  EXPECT_TRUE(std::isnan(unknown.segments[0].frequency));
}

TEST(RegularSegment, IsTheLongestUnlessAnEarlierOneWasFresher) {
  EXPECT_EQ(regular_segment(find_changes(gain_blocks({{8, 80, 100}, {20, 100, 100}}))), 1U);
  EXPECT_EQ(regular_segment(find_changes(gain_blocks({{8, 125, 110}, {20, 100, 100}}))), 0U);
  // More torque alone is no fresher muscle, nor is what comes later, nor a few blocks.
  EXPECT_EQ(regular_segment(find_changes(gain_blocks({{8, 125, 100}, {20, 100, 100}}))), 1U);
  EXPECT_EQ(regular_segment(find_changes(gain_blocks({{20, 100, 100}, {8, 125, 110}}))), 0U);
  EXPECT_EQ(regular_segment(find_changes(gain_blocks({{3, 125, 110}, {20, 100, 100}}))), 1U);
  // Another movement is not compared.
  std::vector<Block> faster = gain_blocks({{8, 125, 110}, {20, 100, 100}});
  for (std::size_t b = 0; b < 8; ++b) faster[b].speed = 4.0;
  EXPECT_EQ(regular_segment(find_changes(faster)), 1U);
  // Without frequencies the longest.
  std::vector<Block> torque_alone = gain_blocks({{8, 125, 110}, {20, 100, 100}});
  for (Block& b : torque_alone) b.frequency = kNan;
  EXPECT_EQ(regular_segment(find_changes(torque_alone)), 1U);
}

TEST(Alike, IsWithinAFactorOfSpeedAndOfTorque) {
  EXPECT_TRUE(alike(1.0, 10.0, 1.5, 7.0, 1.6));
  EXPECT_FALSE(alike(1.0, 10.0, 1.7, 10.0, 1.6));
  EXPECT_FALSE(alike(1.0, 10.0, 1.0, 6.0, 1.6));
}

}  // namespace
}  // namespace myoid::study
