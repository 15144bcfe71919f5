#pragma once

#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Finds times of 0.1 s and more in which the forces on the ground are below a twentieth of the weight although the
/// body does not fall, in trials whose forces otherwise carry half of the weight or more. The body does not fall if the
/// parabola through the mean height of its markers, or of its joint to the ground, is flatter than g/2.
[[nodiscard]] std::vector<Remark> unloaded_times(const body::BodyModel& model,
                                                 const TrialSpec& trial,
                                                 const TrialInput& input);

}  // namespace myoid::study
