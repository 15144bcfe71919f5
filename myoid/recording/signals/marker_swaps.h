#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/remark.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/recording/signals/quality_limits.h"

namespace myoid::recording {

/// Frames begin <= f < end in which two markers carry each other's label.
struct MarkerSwap {
  Eigen::Index first = 0, second = 0;  ///< Indices of the markers.
  Eigen::Index begin = 0, end = 0;     ///< Indices of the frames.
};

/// Finds the times in which two markers have exchanged labels. Each marker is then on the path of
/// the other: with p the position in a frame and e its extrapolation from the last two positions
/// (across gaps of up to `QualityLimits::markers.gap_s`),
///   |p_a - e_b| + |p_b - e_a| < (|p_a - e_a| + |p_b - e_b|) / 4.
/// Markers nearer than `swap_m` are skipped. An exchange that takes a marker away from its usual distance to a marker
/// of the same body is none. The labels of the greater part of the recording are
/// taken as right. An exchange of more than two labels at once is found if it is a chain of pairs.
/// The result is in the order in which to undo the swaps.
[[nodiscard]] std::vector<MarkerSwap> find_swaps(const MarkerSeries& markers);

/// Returns the series with these swaps undone.
[[nodiscard]] MarkerSeries undo_swaps(MarkerSeries markers, const std::vector<MarkerSwap>& swaps);

/// Returns each swap as a fault for a reader.
[[nodiscard]] std::vector<Remark> swap_faults(const MarkerSeries& markers, const std::vector<MarkerSwap>& swaps);

}  // namespace myoid::recording
