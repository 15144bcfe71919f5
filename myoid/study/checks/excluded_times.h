#pragma once

#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/stretch.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Returns stretches with the reach of the motion's smoothing at either side, in which the torque is that of both.
[[nodiscard]] std::vector<Stretch> margined(std::vector<Stretch> times);

/// Says in a note which times of a trial the study leaves out, with their share, and warns of a window outside of it.
/// `foreign`: the times of foreign contacts, which count if the trial excludes them.
[[nodiscard]] std::vector<Remark> excluded_times(const TrialSpec& trial,
                                                 const TrialInput& input,
                                                 const std::vector<Stretch>& foreign);

}  // namespace myoid::study
