#include "myoid/study/intake/study_activation.h"

#include <algorithm>

#include "myoid/ground/core/parallel.h"
#include "myoid/recording/signals/resample.h"

namespace myoid::study {
namespace {

/// Returns the envelope at no more than `rate_hz`, after a low-pass: splines through fewer samples
/// are faster. Negative values of the filter's undershoot are set to 0.
TimeSeries thinned(const TimeSeries& series, double rate_hz) {
  if (series.mean_rate_hz() < 2.0 * rate_hz) return series;
  const Eigen::VectorXd& t = series.time_s();
  TimeSeries slow = recording::resample(series, recording::even_clock(t[0], t[t.size() - 1], rate_hz));
  return {slow.time_s(), slow.channels(), slow.values().cwiseMax(0.0)};
}

/// Returns the trials on which the levels of the EMG may depend: all but the trials held back for
/// validation, or all if every trial is held back.
std::vector<bool> seen_trials(const Study& study) {
  std::vector<bool> seen;
  for (const TrialSpec& trial : study.trials) seen.push_back(trial.use != Use::validation);
  if (std::ranges::find(seen, true) == seen.end()) seen.assign(seen.size(), true);
  return seen;
}

template <typename Work>
void for_each_trial(std::size_t count, const Work& work) {
  parallel_ranges<std::size_t>(count, 1, [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) work(i);
  });
}

using StagesOfTrials = std::vector<const recording::EmgStages*>;  ///< nullptr: no raw EMG.

ComparedEnvelopes compared_envelopes(const Study& study,
                                     const EmgOfTrials& emg,
                                     const StagesOfTrials& stages,
                                     bool without_validation) {
  const std::vector<bool> seen = seen_trials(study);
  ComparedEnvelopes found;
  for (std::size_t i = 0; i < emg.size(); ++i) {
    if (emg[i] == nullptr || (without_validation && !seen[i])) continue;
    const recording::EmgStages* const of = stages[i];
    found.add({study.trials[i].name, study.trials[i].use == Use::mvc, of != nullptr ? &of->envelope : emg[i],
               of != nullptr ? of->bandwidth_hz : Eigen::VectorXd(), of != nullptr ? of->flatness : Eigen::VectorXd()},
              study.trials[i].exclude.windows);
  }
  return found;
}

/// Fills the activations and the normalisation of `found`. The resting levels of `electrodes` hold.
void add_activations(const Study& study,
                     const EmgOfTrials& emg,
                     const StagesOfTrials& stages,
                     std::span<const recording::ChannelNormalisation> electrodes,
                     StudyActivation& found) {
  if (study.emg.kind == EmgKind::activation) {
    for (std::size_t i = 0; i < emg.size(); ++i) {
      if (emg[i] != nullptr) found.trials[i].activation = *emg[i];
    }
    return;
  }
  found.scale.normalisation =
      recording::find_normalisation(compared_envelopes(study, emg, stages, true).trials,
                                    {.window_s = study.emg.normalise_window_s, .electrodes = electrodes});
  for_each_trial(emg.size(), [&](std::size_t i) {
    if (emg[i] == nullptr) return;
    found.trials[i].activation =
        thinned(recording::normalise(stages[i] != nullptr ? stages[i]->envelope : *emg[i], found.scale.normalisation),
                kActivationRate_hz);
  });
}

StagesOfTrials stages_of(const std::vector<TrialActivation>& trials) {
  StagesOfTrials stages;
  for (const TrialActivation& trial : trials) stages.push_back(trial.stages ? &*trial.stages : nullptr);
  return stages;
}

}  // namespace

StudyActivation study_envelopes(const Study& study, const EmgOfTrials& emg) {
  StudyActivation found;
  found.trials.resize(emg.size());
  if (study.emg.kind != EmgKind::raw) return found;
  const recording::EnvelopeOptions& options = study.emg.chain;
  for_each_trial(emg.size(), [&](std::size_t i) {
    if (emg[i] != nullptr) found.trials[i].stages = recording::clean_emg(*emg[i], options);
  });
  // A trial that is held back has a part: a filter follows from the inputs, and a prediction has the EMG.
  std::vector<const recording::EmgStages*> cleaned;
  for (const TrialActivation& trial : found.trials) {
    if (trial.stages) cleaned.push_back(&*trial.stages);
  }
  if (!cleaned.empty()) found.scale.whitening = recording::find_whitening(cleaned, options);
  for_each_trial(found.trials.size(), [&](std::size_t i) {
    if (found.trials[i].stages) recording::add_envelope(*found.trials[i].stages, options, found.scale.whitening);
  });
  return found;
}

void ComparedEnvelopes::add(const recording::TrialEnvelope& whole, const std::vector<Stretch>& windows) {
  constexpr Eigen::Index kLeastSamples = 10;
  const Eigen::VectorXd& t = whole.envelope->time_s();
  const auto is_out = [&](Eigen::Index i) {
    return std::ranges::any_of(windows, [&](const Stretch& w) { return t[i] >= w.begin_s && t[i] <= w.end_s; });
  };
  bool any_out = false;
  for (Eigen::Index i = 0; i < t.size() && !any_out && !windows.empty(); ++i) any_out = is_out(i);
  if (!any_out) {
    trials.push_back(whole);
    return;
  }
  for (Eigen::Index first = 0; first < t.size();) {
    Eigen::Index end = first;
    while (end < t.size() && !is_out(end)) ++end;
    if (end - first >= kLeastSamples) {
      parts.emplace_back(t.segment(first, end - first), whole.envelope->channels(),
                         whole.envelope->values().middleRows(first, end - first));
      trials.push_back(whole);
      trials.back().envelope = &parts.back();
    }
    first = end + 1;
  }
}

ComparedEnvelopes envelopes_of(const Study& study,
                               const EmgOfTrials& emg,
                               const StudyActivation& envelopes,
                               bool without_validation) {
  return compared_envelopes(study, emg, stages_of(envelopes.trials), without_validation);
}

void normalise(const Study& study, const EmgOfTrials& emg, StudyActivation& envelopes) {
  add_activations(study, emg, stages_of(envelopes.trials), {}, envelopes);
}

StudyActivation study_activation(const Study& study, const EmgOfTrials& emg) {
  StudyActivation found = study_envelopes(study, emg);
  normalise(study, emg, found);
  return found;
}

StudyActivation activation_with_uses(const Study& study,
                                     const EmgOfTrials& emg,
                                     const std::vector<const TrialActivation*>& known,
                                     const EmgScale& scale) {
  StudyActivation found;
  found.trials.resize(known.size());
  found.scale.whitening = scale.whitening;
  StagesOfTrials stages;
  for (const TrialActivation* trial : known) stages.push_back(trial->stages ? &*trial->stages : nullptr);
  add_activations(study, emg, stages, scale.normalisation, found);
  return found;
}

}  // namespace myoid::study
