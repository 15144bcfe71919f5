#pragma once

#include <string>
#include <vector>

#include "myoid/files/marker_series.h"
#include "myoid/signals/quality_limits.h"
#include "myoid/signals/rigid_segment.h"

namespace myoid::signals {

struct MendOptions {
  bool undo_swaps = true;
  bool fill_gaps = true;
  QualityLimits limits;
};

/// Markers as they are used from here on, and every change in a sentence.
struct MendedMarkers {
  recording::MarkerSeries markers;
  std::vector<std::string> repairs;
};

/// Swapped labels are exchanged back (`find_swaps`). Then gaps, where the marker is seen before and
/// after:
///
/// - of up to `limits.gap_s`: a cubic spline through four frames on either side, 0.03 s apart;
/// - longer ones: from the segment, where three other markers of it are seen: the segment's mean
///   shape laid on them, shifted so that both ends of the gap are met.
///
/// All others stay gaps: nothing is known there. A segment whose markers lie on a line is left out.
[[nodiscard]] MendedMarkers mend_markers(recording::MarkerSeries markers,
                                         const std::vector<RigidSegment>& segments,
                                         const MendOptions& options = {});

}  // namespace myoid::signals
