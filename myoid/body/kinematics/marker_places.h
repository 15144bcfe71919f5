#pragma once

#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/files/marker_series.h"

namespace myoid::body {

/// A recorded marker without a place in the model, at the place of a marker of the model that nothing was recorded for.
struct PlacedMarker {
  std::string recorded, wanted;
  double distance_m = 0.0;  ///< Median over the frames.
};

/// Finds recorded markers under another name by their place: each body with three or more markers under the model's
/// names, not on a line, is laid onto them by a rigid fit with one scale, and the model's further markers on it must
/// have a recorded marker within 4 cm (twice the fit's residual, if that is less, but no less than 2 cm), that stays at
/// its place on the body and is the only one so near. Names play no part: `T1` and `c7` are as alike as two names can
/// be, and are two vertebrae. A pair that is not found may still be one marker: bodies with fewer markers tell nothing.
[[nodiscard]] std::vector<PlacedMarker> markers_by_place(const body::BodyModel& model, const MarkerSeries& markers);

/// Returns "recorded markers stand at places of the model's under another name: 'X' where the model has 'Y' (12 mm),
/// ...": all pairs in one line, as a question.
[[nodiscard]] std::string place_question(const std::vector<PlacedMarker>& pairs);

}  // namespace myoid::body
