#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "myoid/ground/core/time_series.h"
#include "myoid/recording/signals/emg_envelope.h"
#include "myoid/recording/signals/emg_levels.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// The EMG of one trial.
struct TrialActivation {
  std::optional<recording::EmgStages> stages;  ///< Stages of raw EMG; empty for other EMG.
  TimeSeries activation;                       ///< One channel for each EMG channel, 0..1; empty without EMG.
};

/// The scale of a study's EMG: one for all trials.
struct EmgScale {
  recording::Whitening whitening;                              ///< For raw EMG.
  std::vector<recording::ChannelNormalisation> normalisation;  ///< Empty if the EMG is given as activations.
};

/// The EMG of all trials, in the study's order.
struct StudyActivation {
  std::vector<TrialActivation> trials;
  EmgScale scale;
};

/// The EMG as its files hold it, one series for each trial of the study; nullptr: no EMG.
using EmgOfTrials = std::vector<const TimeSeries*>;

/// The rate [Hz] that activations are thinned to.
inline constexpr double kActivationRate_hz = 200.0;

/// Turns the EMG of all trials into activations: `study_envelopes`, then `normalise`.
[[nodiscard]] StudyActivation study_activation(const Study& study, const EmgOfTrials& emg);

/// Cleans, whitens (one filter for all trials of the study) and rectifies raw EMG; given envelopes and
/// activations stay unchanged. The activations are empty. Throws as `recording::clean_emg`.
[[nodiscard]] StudyActivation study_envelopes(const Study& study, const EmgOfTrials& emg);

/// Envelopes for a comparison of levels: a trial without its excluded windows is several.
struct ComparedEnvelopes {
  std::vector<recording::TrialEnvelope> trials;
  std::deque<TimeSeries> parts;  ///< Owns the parts of trials.
  /// Adds an envelope; only its parts outside the windows, if there are any.
  void add(const recording::TrialEnvelope& whole, const std::vector<Stretch>& windows);
};

/// Returns the envelopes of the trials that have EMG, without the windows that the study excludes; with
/// `without_validation`, omits the trials held back for validation.
[[nodiscard]] ComparedEnvelopes envelopes_of(const Study& study,
                                             const EmgOfTrials& emg,
                                             const StudyActivation& envelopes,
                                             bool without_validation);

/// Divides the envelopes by the study's greatest effort and thins them to kActivationRate_hz, for
/// `TrialActivation::activation` and `EmgScale::normalisation`. Trials held back for validation have no part in the
/// greatest effort. Given activations stay unchanged. Throws InvalidInput as `recording::find_normalisation`.
void normalise(const Study& study, const EmgOfTrials& emg, StudyActivation& envelopes);

/// Returns the activations of the same trials with the uses of `study`, from the envelopes of `known` behind the filter
/// and above the resting levels of `scale`, which are those of the electrodes. The stages are empty.
[[nodiscard]] StudyActivation activation_with_uses(const Study& study,
                                                   const EmgOfTrials& emg,
                                                   const std::vector<const TrialActivation*>& known,
                                                   const EmgScale& scale);

}  // namespace myoid::study
