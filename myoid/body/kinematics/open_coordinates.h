#pragma once

#include <string>
#include <vector>

#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/files/marker_series.h"

namespace myoid::body {

/// Returns the free coordinates that the markers leave open (IkResult::open_coordinates) in each of three frames,
/// solved for themselves: the first, the middle and the last of those that show most markers; and in a posture with
/// bent limbs. Throws as inverse_kinematics.
[[nodiscard]] std::vector<std::string> open_coordinates(const body::BodyModel& model,
                                                        const MarkerSeries& markers,
                                                        const IkOptions& options = {});

}  // namespace myoid::body
