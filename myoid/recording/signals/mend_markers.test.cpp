#include "myoid/recording/signals/mend_markers.h"

#include <gtest/gtest.h>

#include "tests/support/moving_markers.h"

namespace myoid::recording {
namespace {

using ground::MarkerSeries;

TEST(MendMarkers, LeavesACleanRecordingAsItIs) {
  const MarkerSeries markers = test::moving_markers();
  const MendedMarkers mended = mend_markers(markers, {test::forearm()});
  EXPECT_TRUE(mended.swaps.empty());
  EXPECT_TRUE(mended.filled.empty());
  EXPECT_EQ(mended.markers.positions_m, markers.positions_m);
}

TEST(MendMarkers, FillsAShortGapByASplineAndSaysSo) {
  const MarkerSeries truth = test::moving_markers(400, 100.0, 0.0);
  MarkerSeries markers = truth;
  test::hide(markers, 1, 200, 210);
  const MendedMarkers mended = mend_markers(markers, {});
  ASSERT_EQ(mended.filled.size(), 1U);
  EXPECT_TRUE(mended.filled.at("B").starts_with("10 ")) << mended.filled.at("B");
  // A cubic over T = 0.11 s: T^4/384 times the fourth derivative, here up to 0.26 m (3 to 7
  // rad/s)^4 = 100 to 200 m/s^4: 0.1 mm; the natural ends add as much.
  EXPECT_LT((mended.markers.positions_m - truth.positions_m).cwiseAbs().maxCoeff(), 5e-4);
}

TEST(MendMarkers, FillsALongGapFromTheSegment) {
  const MarkerSeries truth = test::moving_markers();
  MarkerSeries markers = truth;
  test::hide(markers, 1, 150, 280);
  const MendedMarkers mended = mend_markers(markers, {test::forearm()});
  ASSERT_EQ(mended.filled.size(), 1U);
  EXPECT_TRUE(mended.filled.at("B").starts_with("130 ")) << mended.filled.at("B");
  EXPECT_NE(mended.filled.at("B").find("segment"), std::string::npos);
  // Noise of 0.5 mm in each of four markers, carried out to the one that lies farthest off.
  EXPECT_LT((mended.markers.positions_m - truth.positions_m).cwiseAbs().maxCoeff(), 0.005);
}

TEST(MendMarkers, LeavesWhatNobodyKnows) {
  MarkerSeries markers = test::moving_markers();
  test::hide(markers, 1, 150, 280);  // long, no segment given
  test::hide(markers, 2, 0, 5);      // nothing before
  test::hide(markers, 3, 390, 400);  // nothing after
  const MendedMarkers mended = mend_markers(markers, {});
  EXPECT_TRUE(mended.swaps.empty());
  EXPECT_TRUE(mended.filled.empty());
  EXPECT_TRUE(mended.markers.missing(200, 1));
  // Two of the others are missing as well: at most three remain, in places two.
  test::hide(markers, 0, 200, 210);
  test::hide(markers, 4, 200, 210);
  EXPECT_TRUE(mend_markers(markers, {test::forearm()}).markers.missing(205, 1));
}

TEST(MendMarkers, UndoesASwapBeforeItFills) {
  const MarkerSeries truth = test::moving_markers();
  MarkerSeries markers = truth;
  markers.positions_m.block(100, 3, 50, 3).swap(markers.positions_m.block(100, 9, 50, 3));
  test::hide(markers, 1, 120, 130);
  const MendedMarkers mended = mend_markers(markers, {test::forearm()});
  EXPECT_EQ(mended.swaps.size(), 1U);
  EXPECT_EQ(mended.filled.size(), 1U);
  EXPECT_LT((mended.markers.positions_m - truth.positions_m).cwiseAbs().maxCoeff(), 0.003);
  const MendedMarkers left = mend_markers(markers, {}, {.undo_swaps = false, .fill_gaps = false});
  EXPECT_TRUE(left.swaps.empty());
  EXPECT_TRUE(left.filled.empty());
  EXPECT_TRUE(left.markers.missing(125, 1));
}

}  // namespace
}  // namespace myoid::recording
