#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/remark.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/recording/signals/quality_limits.h"
#include "myoid/recording/signals/rigid_segment.h"

namespace myoid::recording {

/// Frames begin <= f < end in which a marker is missing.
struct MarkerGap {
  Eigen::Index marker = 0;
  Eigen::Index begin = 0, end = 0;
};

/// Finds all gaps, by marker and then by time.
[[nodiscard]] std::vector<MarkerGap> find_marker_gaps(const MarkerSeries& markers);

/// Reports one fault for each marker that is missing in a frame; grave beyond the limits.
[[nodiscard]] std::vector<Remark> check_marker_gaps(const MarkerSeries& markers);

/// Reports markers that leave the path through their neighbors in time. The departure
///   |p_i - (-p_{i-2} + 4 p_{i-1} + 4 p_{i+1} - p_{i+2}) / 6|
/// vanishes on a cubic. It is 0 to 1 mm for people at 100 Hz, the height of a spike, and half the
/// height of a step. A departure below ten times the marker's own median, or below that of a
/// movement of 0.2 m at 4 Hz, is no fault. One fault for each marker, at its worst frame.
[[nodiscard]] std::vector<Remark> check_marker_jumps(const MarkerSeries& markers);

/// Positions of a segment's markers in the model.
struct ExpectedSegment {
  RigidSegment segment;
  Eigen::Matrix3Xd local_m;  ///< One column for each of its markers.
};

/// Checks the unit of length. Compares the distances within segments with the model's, or without
/// segments the distance of the two outermost markers with that of a person (3 cm to 5 m). A factor
/// of a power of ten names the probable unit.
[[nodiscard]] std::optional<Remark> check_marker_unit(const MarkerSeries& markers,
                                                      const std::vector<ExpectedSegment>& expected);

/// Runs all checks of markers: swaps first, then jumps in the frames without swaps.
[[nodiscard]] std::vector<Remark> check_markers(const MarkerSeries& markers,
                                                const std::vector<ExpectedSegment>& expected = {});

}  // namespace myoid::recording
