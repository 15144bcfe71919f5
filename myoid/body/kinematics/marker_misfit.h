#pragma once

#include <string>
#include <vector>

#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/recording/signals/marker_quality.h"

namespace myoid::body {

/// Returns the model's segments that carry two or more of these markers, with the places of the
/// markers. Welded bodies form one segment.
[[nodiscard]] std::vector<recording::ExpectedSegment> segments_of(const body::BodyModel& model,
                                                                  const MarkerSeries& markers);

/// Returns six frames at even distances, the first and the last included, or all of fewer: for a quick look.
[[nodiscard]] MarkerSeries spread_frames(const MarkerSeries& markers);

struct MarkerMisfit {
  double rms_m = 0.0;       ///< Over all markers of the frames in which markers were seen.
  bool wrong_unit = false;  ///< The recording is not in the unit that its file says.
  /// A warning if the markers lie more than 4 cm off, else empty. Names the unit that was probably
  /// meant, from distances within the model's segments, and a shift that all markers share.
  std::string warning;
};

/// Measures the distances of the measured markers from the model's after inverse kinematics.
[[nodiscard]] MarkerMisfit marker_misfit(const body::BodyModel& model,
                                         const MarkerSeries& markers,
                                         const IkResult& solved);

}  // namespace myoid::body
