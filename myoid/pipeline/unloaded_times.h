#pragma once

#include <vector>

#include "myoid/model/body_model.h"
#include "myoid/pipeline/finding.h"
#include "myoid/pipeline/study.h"
#include "myoid/pipeline/trial_input.h"

namespace myoid::pipeline {

/// Times of 0.1 s and more in which the forces on the ground, which elsewhere carry half of the
/// weight and more, are below a twentieth of it although the body does not fall (the parabola
/// through the mean height of its markers, or of its joint to the ground, is flatter than g/2).
[[nodiscard]] std::vector<Finding> unloaded_times(const model::BodyModel& model,
                                                  const TrialSpec& trial,
                                                  const TrialInput& input);

}  // namespace myoid::pipeline
