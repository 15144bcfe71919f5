#pragma once

#include <filesystem>
#include <functional>

#include "myoid/core/time_series.h"
#include "myoid/intake/trial_input.h"
#include "myoid/signals/emg_envelope.h"
#include "myoid/study/study.h"

namespace myoid {

/// How the study wants raw EMG to become envelopes.
[[nodiscard]] signals::EnvelopeOptions envelope_options(const Study& study);

/// The EMG of a trial, the channels of the study's muscles alone, put on the clock of the motion
/// that `input` already holds and cut to the trial's times, from 0.5 s before on: the delay reaches
/// back. Notes, warnings and the clock go to `input`; `remember` is told of every further file.
/// Throws ReadError for a missing channel, an envelope or activation that cannot be one, and EMG
/// that covers less than half of the motion; as `check_clock` and `trial_clock`.
[[nodiscard]] TimeSeries read_trial_emg(
    const Study& study,
    const TrialSpec& trial,
    const std::function<void(const std::filesystem::path&)>& remember,
    TrialInput& input);

}  // namespace myoid
