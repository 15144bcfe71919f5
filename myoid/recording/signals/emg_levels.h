#pragma once

#include <span>
#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/recording/signals/emg_envelope.h"
#include "myoid/recording/signals/quality_limits.h"

namespace myoid::recording {

/// Returns the total time [s] of samples above `level`. The spike of an artefact is short; a signal
/// in percent is above 2 as long as the muscle works.
[[nodiscard]] double time_above_s(const Eigen::Ref<const Eigen::VectorXd>& samples, double rate_hz, double level);

/// Checks each channel over all trials: the signal must rise from rest (largest over smallest
/// mean of `kPause_s`); it is an error if no half second is `noise_rises` times as strong as another, the spectrum
/// is that of noise, and the level is below `noise_v`; it is a note if the level is never below `noise_v`. No trial may
/// be steady noise of another level than the channel's rest in at least three other trials, or white noise while the
/// muscle works in all others. No movement may exceed the maximal contractions. A channel that some trials lack is
/// checked in the others. A trial whose channels all exceed the maximal contractions tenfold, at rest too, is in
/// another unit: an error; one whose channels all differ from the other trials by one ratio has another gain: a
/// warning. Neither takes part in the other checks.
[[nodiscard]] std::vector<Remark> check_emg_levels(std::span<const TrialEnvelope> trials);

}  // namespace myoid::recording
