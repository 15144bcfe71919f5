#pragma once

#include <optional>

#include "myoid/core/remark.h"
#include "myoid/files/marker_series.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// Returns an error if the markers of a trial leave a coordinate of the study open (kinematics/open_coordinates.h): its
/// angle would be the one that the search began with.
[[nodiscard]] std::optional<Remark> open_joint(const Study& study,
                                               const model::BodyModel& model,
                                               const TrialSpec& trial,
                                               const recording::MarkerSeries& markers);

}  // namespace myoid
