#pragma once

#include <vector>

#include "myoid/files/marker_series.h"
#include "myoid/model/body_model.h"
#include "myoid/signals/marker_quality.h"

namespace myoid::kinematics {

/// Returns the model's segments that carry two or more of these markers, with the places of the
/// markers. Welded bodies form one segment.
[[nodiscard]] std::vector<signals::ExpectedSegment> segments_of(const model::BodyModel& model,
                                                                const recording::MarkerSeries& markers);

}  // namespace myoid::kinematics
