#include "myoid/recording/signals/marker_swaps.h"

#include <gtest/gtest.h>

#include "tests/support/moving_markers.h"

namespace myoid::recording {
namespace {

using ground::MarkerSeries;

/// The labels of two markers exchanged.
void exchange(MarkerSeries& m, Eigen::Index a, Eigen::Index b, Eigen::Index begin, Eigen::Index end) {
  const Eigen::MatrixXd kept = m.positions_m.block(begin, 3 * a, end - begin, 3);
  m.positions_m.block(begin, 3 * a, end - begin, 3) = m.positions_m.block(begin, 3 * b, end - begin, 3).eval();
  m.positions_m.block(begin, 3 * b, end - begin, 3) = kept;
}

/// Greatest distance from the true positions, where both are seen.
double error_m(const MarkerSeries& a, const MarkerSeries& b) {
  double worst = 0.0;
  for (Eigen::Index f = 0; f < a.frame_count(); ++f) {
    for (Eigen::Index m = 0; m < a.marker_count(); ++m) {
      if (!a.missing(f, m) && !b.missing(f, m)) worst = std::max(worst, (a.position(f, m) - b.position(f, m)).norm());
    }
  }
  return worst;
}

TEST(MarkerSwaps, InACleanRecordingThereAreNone) {
  for (const double rate_hz : {30.0, 60.0, 100.0, 250.0}) {
    EXPECT_TRUE(find_swaps(test::moving_markers(600, rate_hz, 0.001)).empty()) << rate_hz;
  }
}

TEST(MarkerSwaps, AreFoundWithTheirFramesAndUndone) {
  const MarkerSeries truth = test::moving_markers();
  MarkerSeries swapped = truth;
  exchange(swapped, 1, 3, 120, 180);
  const auto swaps = find_swaps(swapped);
  ASSERT_EQ(swaps.size(), 1U);
  EXPECT_EQ(swaps[0].begin, 120);
  EXPECT_EQ(swaps[0].end, 180);
  EXPECT_EQ(error_m(undo_swaps(swapped, swaps), truth), 0.0);
  const auto faults = swap_faults(swapped, swaps);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].about, "B, D");
  EXPECT_DOUBLE_EQ(faults[0].when->begin_s, truth.time_s[120]);
}

TEST(MarkerSwaps, ThatLastToTheEndAreUndoneOnTheShorterSide) {
  const MarkerSeries truth = test::moving_markers();
  for (const Eigen::Index from : {90, 310}) {
    MarkerSeries swapped = truth;
    if (from > 200) exchange(swapped, 0, 4, from, 400);
    if (from < 200) exchange(swapped, 0, 4, 0, from);
    EXPECT_EQ(error_m(undo_swaps(swapped, find_swaps(swapped)), truth), 0.0) << from;
  }
}

TEST(MarkerSwaps, BehindAShortGapAreFoundToo) {
  const MarkerSeries truth = test::moving_markers();
  MarkerSeries swapped = truth;
  exchange(swapped, 1, 4, 120, 180);
  test::hide(swapped, 1, 115, 125);
  test::hide(swapped, 4, 115, 125);
  EXPECT_EQ(error_m(undo_swaps(swapped, find_swaps(swapped)), truth), 0.0);
}

TEST(MarkerSwaps, OfSeveralPairsOneAfterTheOtherAreUndone) {
  const MarkerSeries truth = test::moving_markers();
  MarkerSeries swapped = truth;
  exchange(swapped, 0, 1, 50, 200);
  exchange(swapped, 1, 2, 100, 150);
  EXPECT_EQ(error_m(undo_swaps(swapped, find_swaps(swapped)), truth), 0.0);
}

TEST(MarkerSwaps, APathThatIsLostInBadFramesExchangesNothing) {
  // The labels are wrong in four frames. In the gap behind them the paths are lost, and then the labels are right.
  const MarkerSeries truth = test::moving_markers();
  for (const Eigen::Index from : {100, 300}) {
    MarkerSeries recorded = truth;
    exchange(recorded, 1, 3, from, from + 4);
    for (const Eigen::Index m : {1, 3}) test::hide(recorded, m, from + 4, from + 50);
    const MarkerSeries mended = undo_swaps(recorded, find_swaps(recorded));
    EXPECT_EQ(mended.positions_m.topRows(from), truth.positions_m.topRows(from)) << from;
    EXPECT_EQ(mended.positions_m.bottomRows(350 - from), truth.positions_m.bottomRows(350 - from)) << from;
  }
}

TEST(MarkerSwaps, AJumpOfOneMarkerIsNone) {
  MarkerSeries markers = test::moving_markers();
  markers.positions_m.block(200, 3, 50, 3).array() += 0.1;
  EXPECT_TRUE(find_swaps(markers).empty());
}

}  // namespace
}  // namespace myoid::recording
