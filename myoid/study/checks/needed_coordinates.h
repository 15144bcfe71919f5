#pragma once

#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Returns the coordinates on which the trial's numbers depend: those of the study, those that change the paths of its
/// muscles and, unless the torque was measured, those of the joints between the ground and the study's joints, and of
/// the joints that these carry: weight and inertia depend on them.
[[nodiscard]] std::vector<std::string> needed_coordinates(const Study& study,
                                                          const body::BodyModel& model,
                                                          const TrialSpec& trial);

}  // namespace myoid::study
