#pragma once

#include "myoid/ground/core/time_series.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Reads the EMG of a trial: only the channels of the study's muscles, on the clock of the motion in `input`, cut to
/// the trial's times and 0.5 s before, which the delay needs. Notes, warnings and the clock go to `input`; `remember`
/// receives every further file. Throws ReadError for a missing channel, an impossible envelope or activation, and EMG
/// that covers less than half of the motion; also as `check_clock` and `trial_clock`.
[[nodiscard]] TimeSeries read_trial_emg(const Study& study,
                                        const TrialSpec& trial,
                                        const Remember& remember,
                                        TrialInput& input);

}  // namespace myoid::study
