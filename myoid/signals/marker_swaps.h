#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/core/remark.h"
#include "myoid/files/marker_series.h"
#include "myoid/signals/quality_limits.h"

namespace myoid::signals {

/// Frames begin <= f < end in which two markers carry each other's label.
struct MarkerSwap {
  Eigen::Index first = 0, second = 0;  ///< Markers.
  Eigen::Index begin = 0, end = 0;     ///< Frames.
};

/// Two markers changed labels where each is found on the path of the other: with p the position in
/// a frame and e what the last two positions lead to expect (over gaps of up to
/// `QualityLimits::gap_s` too),
///   |p_a - e_b| + |p_b - e_a| < (|p_a - e_a| + |p_b - e_b|) / 4,
/// markers nearer than `swap_m` left alone. The labels of the greater part of the recording are
/// taken for the right ones. Rows of more than two that change at once are found as a chain of
/// pairs where they are one. In the order to undo them.
[[nodiscard]] std::vector<MarkerSwap> find_swaps(const recording::MarkerSeries& markers,
                                                 const QualityLimits& limits = {});

/// The series with these labels put right.
[[nodiscard]] recording::MarkerSeries undo_swaps(recording::MarkerSeries markers,
                                                 const std::vector<MarkerSwap>& swaps);

/// Each of them as a fault, for a reader.
[[nodiscard]] std::vector<Remark> swap_faults(const recording::MarkerSeries& markers,
                                              const std::vector<MarkerSwap>& swaps);

}  // namespace myoid::signals
