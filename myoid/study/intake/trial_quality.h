#pragma once

#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Returns the motion of a trial: its coordinates, or the paths of the markers that are never lost.
[[nodiscard]] TimeSeries movement_of(const TrialInput& input);

/// Returns the faults of a trial's EMG and clocks, and of its markers before mending. `envelope` is
/// empty or the trial's EMG envelope.
[[nodiscard]] std::vector<Remark> trial_faults(const Study& study, const TrialInput& input, const TimeSeries& envelope);

}  // namespace myoid::study
