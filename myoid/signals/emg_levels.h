#pragma once

#include <span>
#include <vector>

#include "myoid/core/remark.h"
#include "myoid/signals/emg_envelope.h"
#include "myoid/signals/quality_limits.h"

namespace myoid::signals {

/// How long the samples are above `level` in all [s]: a spike of an artefact is short, a signal in
/// percent is above 2 for as long as the muscle works.
[[nodiscard]] double time_above_s(const Eigen::Ref<const Eigen::VectorXd>& samples,
                                  double rate_hz,
                                  double level);

/// Looks at all trials together, channel by channel: does the signal rise from rest (largest 0.5 s
/// mean over smallest 1 s mean), and does no movement exceed the maximal contractions? Channels
/// that some trial does not have are looked at where they are.
[[nodiscard]] std::vector<Remark> check_emg_levels(std::span<const TrialEnvelope> trials,
                                                   const QualityLimits& limits = {});

}  // namespace myoid::signals
