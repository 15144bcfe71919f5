#include "myoid/recording/signals/marker_quality.h"

#include <gtest/gtest.h>

#include "tests/support/moving_markers.h"

namespace myoid::recording {
namespace {

using ground::MarkerSeries;

std::vector<ExpectedSegment> expected() { return {{test::forearm(), test::forearm_shape()}}; }

TEST(MarkerQuality, OfACleanRecordingNothingIsSaid) {
  for (const double rate_hz : {30.0, 60.0, 100.0, 250.0}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      EXPECT_TRUE(check_markers(test::moving_markers(600, rate_hz, 0.001, seed), expected()).empty()) << rate_hz;
    }
  }
}

TEST(MarkerQuality, GapsAreCountedAndTheLongestIsNamed) {
  MarkerSeries markers = test::moving_markers();
  test::hide(markers, 2, 50, 60);
  test::hide(markers, 2, 200, 240);
  test::hide(markers, 0, 300, 305);
  const auto gaps = find_marker_gaps(markers);
  ASSERT_EQ(gaps.size(), 3U);
  EXPECT_EQ(gaps[2].begin, 200);
  EXPECT_EQ(gaps[2].end, 240);
  const auto faults = check_marker_gaps(markers);
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].severity, Severity::note);     // A: 0.05 s
  EXPECT_EQ(faults[1].severity, Severity::warning);  // C: 0.4 s
  EXPECT_NEAR(*faults[1].value, 0.4, 1e-9);
  EXPECT_NE(faults[1].says.find("2 to 2.39 s"), std::string::npos) << faults[1].says;
}

TEST(MarkerQuality, ASpikeAndAStepAreJumpsOfTheirMarkerAtTheirTime) {
  MarkerSeries markers = test::moving_markers();
  markers.positions_m(150, 4) += 0.05;                        // B, one frame
  markers.positions_m.block(250, 9, 150, 1).array() += 0.08;  // D, from there on
  const auto faults = check_marker_jumps(markers);
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].about, "B");
  EXPECT_NEAR(*faults[0].value, 0.05, 0.005);
  EXPECT_NEAR(faults[0].when->begin_s, 1.5, 0.02);
  EXPECT_EQ(faults[1].about, "D");
  EXPECT_NEAR(*faults[1].value, 0.04, 0.005);  // half of a step
  EXPECT_NEAR(faults[1].when->begin_s, 2.5, 0.02);
}

TEST(MarkerQuality, AWrongUnitIsGuessed) {
  MarkerSeries markers = test::moving_markers();
  EXPECT_FALSE(check_marker_unit(markers, expected()));
  EXPECT_FALSE(check_marker_unit(markers, {}));
  markers.positions_m *= 1000.0;
  const auto fault = check_marker_unit(markers, expected());
  ASSERT_TRUE(fault);
  EXPECT_NEAR(*fault->value, 1000.0, 20.0);
  EXPECT_NE(fault->remedy.find("millimeters that"), std::string::npos);
  // A model makes the unit certain; the outermost markers alone do not.
  EXPECT_EQ(fault->severity, Severity::error);
  EXPECT_EQ(check_marker_unit(markers, {})->severity, Severity::warning);
  // In a wrong unit no other check of lengths runs.
  EXPECT_EQ(check_markers(markers, expected()).size(), 1U);
  markers.positions_m *= 1e-6;
  EXPECT_NE(check_marker_unit(markers, expected())->remedy.find("as millimeters"), std::string::npos);
}

TEST(MarkerQuality, ASwapIsToldAsASwapAndNotAsJumps) {
  MarkerSeries markers = test::moving_markers();
  markers.positions_m.block(100, 3, 50, 3).swap(markers.positions_m.block(100, 9, 50, 3));
  const auto faults = check_markers(markers, expected());
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].code, RemarkCode::marker_swap);
}

}  // namespace
}  // namespace myoid::recording
