#pragma once

#include <string>
#include <vector>

#include "myoid/files/marker_series.h"
#include "myoid/kinematics/inverse_kinematics.h"
#include "myoid/model/body_model.h"

namespace myoid::kinematics {

/// Returns the free coordinates that the markers leave open (IkResult::undetermined) in each of three frames, solved
/// for themselves: the first, the middle and the last of those that show most markers; and in a posture with bent
/// limbs. Throws as inverse_kinematics.
[[nodiscard]] std::vector<std::string> open_coordinates(const model::BodyModel& model,
                                                        const recording::MarkerSeries& markers,
                                                        const IkOptions& options = {});

}  // namespace myoid::kinematics
