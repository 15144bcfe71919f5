#pragma once

#include <optional>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Returns an error if the markers of a trial leave a coordinate of the study open
/// (body/kinematics/open_coordinates.h): its angle would be the one that the search began with.
[[nodiscard]] std::optional<Remark> open_joint(const Study& study,
                                               const body::BodyModel& model,
                                               const TrialSpec& trial,
                                               const MarkerSeries& markers);

}  // namespace myoid::study
