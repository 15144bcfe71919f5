#pragma once

#include <vector>

#include "myoid/core/remark.h"
#include "myoid/intake/trial_input.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// Times of 0.1 s and more in which the forces on the ground, which elsewhere carry half of the
/// weight and more, are below a twentieth of it although the body does not fall (the parabola
/// through the mean height of its markers, or of its joint to the ground, is flatter than g/2).
[[nodiscard]] std::vector<Remark> unloaded_times(const model::BodyModel& model,
                                                 const TrialSpec& trial,
                                                 const TrialInput& input);

}  // namespace myoid
