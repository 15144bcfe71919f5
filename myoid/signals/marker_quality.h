#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/remark.h"
#include "myoid/files/marker_series.h"
#include "myoid/signals/quality_limits.h"
#include "myoid/signals/rigid_segment.h"

namespace myoid::signals {

/// Frames begin <= f < end in which a marker is missing.
struct MarkerGap {
  Eigen::Index marker = 0;
  Eigen::Index begin = 0, end = 0;
};

/// All gaps, by marker and then by time.
[[nodiscard]] std::vector<MarkerGap> find_marker_gaps(const recording::MarkerSeries& markers);

/// One fault per marker that is missing somewhere; grave beyond the limits.
[[nodiscard]] std::vector<Remark> check_marker_gaps(const recording::MarkerSeries& markers,
                                                    const QualityLimits& limits = {});

/// A marker that leaves the path through its neighbors in time:
///   |p_i - (-p_{i-2} + 4 p_{i-1} + 4 p_{i+1} - p_{i+2}) / 6|,
/// which vanishes on a cubic, is 0 to 1 mm for people at 100 Hz and the height of a spike (half
/// that of a step) else. Below ten times the marker's own median, or what 4 Hz of 0.2 m give at
/// this rate, nothing is said. One fault per marker, at its worst.
[[nodiscard]] std::vector<Remark> check_marker_jumps(const recording::MarkerSeries& markers,
                                                     const QualityLimits& limits = {});

/// Where the markers sit on the model's segments, to compare with.
struct ExpectedSegment {
  RigidSegment segment;
  Eigen::Matrix3Xd local_m;  ///< One column per marker of it.
};

/// Are these meters? Compares the distances within segments with the model's, or without segments
/// the distance of the two outermost markers with that of a person (3 cm to 5 m). A power of ten
/// names the unit that was probably meant.
[[nodiscard]] std::optional<Remark> check_marker_unit(const recording::MarkerSeries& markers,
                                                      const std::vector<ExpectedSegment>& expected);

/// All checks of markers, swaps first, the jumps in what is left of them.
[[nodiscard]] std::vector<Remark> check_markers(const recording::MarkerSeries& markers,
                                                const std::vector<ExpectedSegment>& expected = {},
                                                const QualityLimits& limits = {});

}  // namespace myoid::signals
