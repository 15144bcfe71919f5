#pragma once

#include <map>
#include <string>
#include <vector>

#include "myoid/ground/files/marker_series.h"
#include "myoid/recording/signals/quality_limits.h"
#include "myoid/recording/signals/rigid_segment.h"

namespace myoid::recording {

struct MendOptions {
  bool undo_swaps = true;
  bool fill_gaps = true;
};

/// Repaired markers, with words for every change.
struct MendedMarkers {
  MarkerSeries markers;
  std::vector<std::string> swaps;             ///< A sentence for each exchange.
  std::map<std::string, std::string> filled;  ///< By marker: "10 frames filled by a spline".
};

/// Undoes swaps (`find_swaps`), then fills gaps before and after which the marker is seen:
///
/// - up to `QualityLimits::markers.gap_s`: a cubic spline through four frames on either side, 0.03 s apart;
/// - longer: from the segment, if three other markers of it are seen. The segment's mean shape is laid on these markers
///   and shifted so that both ends of the gap match.
///
/// All other gaps stay. A segment whose markers lie on a line fills none.
[[nodiscard]] MendedMarkers mend_markers(MarkerSeries markers,
                                         const std::vector<RigidSegment>& segments,
                                         const MendOptions& options = {});

}  // namespace myoid::recording
