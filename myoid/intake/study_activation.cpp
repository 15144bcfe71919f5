#include "myoid/intake/study_activation.h"

#include <algorithm>

#include "myoid/core/parallel.h"
#include "myoid/intake/trial_emg.h"
#include "myoid/signals/resample.h"

namespace myoid {
namespace {

/// Returns the envelope at no more than `rate_hz`, after a low-pass: splines through fewer samples
/// are faster. Negative values of the filter's undershoot are set to 0.
TimeSeries thinned(const TimeSeries& series, double rate_hz) {
  if (series.mean_rate_hz() < 2.0 * rate_hz) return series;
  const Eigen::VectorXd& t = series.time_s();
  TimeSeries slow = signals::resample(series, signals::even_clock(t[0], t[t.size() - 1], rate_hz));
  return {slow.time_s(), slow.channels(), slow.values().cwiseMax(0.0)};
}

/// Returns the trials on which filters and levels of the EMG may depend: all but the trials held
/// back for validation, or all if every trial is held back.
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

/// Computes envelopes of clean EMG.
void add_envelopes(const Study& study, StudyActivation& clean) {
  const signals::EnvelopeOptions options = envelope_options(study);
  const std::vector<bool> seen = seen_trials(study);
  std::vector<const signals::EmgStages*> stages;
  for (std::size_t i = 0; i < clean.trials.size(); ++i) {
    if (clean.trials[i].stages && seen[i]) stages.push_back(&*clean.trials[i].stages);
  }
  if (!stages.empty()) clean.scale.whitening = signals::find_whitening(stages, options);
  for_each_trial(clean.trials.size(), [&](std::size_t i) {
    if (clean.trials[i].stages) signals::add_envelope(*clean.trials[i].stages, options, clean.scale.whitening);
  });
}

}  // namespace

StudyActivation study_envelopes(const Study& study, const EmgOfTrials& emg) {
  StudyActivation found;
  found.trials.resize(emg.size());
  if (study.emg.kind != EmgKind::raw) return found;
  const signals::EnvelopeOptions options = envelope_options(study);
  for_each_trial(emg.size(), [&](std::size_t i) {
    if (emg[i] != nullptr) found.trials[i].stages = signals::clean_emg(*emg[i], options);
  });
  add_envelopes(study, found);
  return found;
}

void ComparedEnvelopes::add(const signals::TrialEnvelope& whole, const std::vector<Stretch>& windows) {
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
  const std::vector<bool> seen = seen_trials(study);
  ComparedEnvelopes found;
  for (std::size_t i = 0; i < emg.size(); ++i) {
    if (emg[i] == nullptr || (without_validation && !seen[i])) continue;
    const auto& stages = envelopes.trials[i].stages;
    found.add({study.trials[i].name, study.trials[i].use == Use::mvc, stages ? &stages->envelope : emg[i],
               stages ? stages->bandwidth_hz : Eigen::VectorXd(), stages ? stages->flatness : Eigen::VectorXd()},
              study.trials[i].exclude.windows);
  }
  return found;
}

void normalise(const Study& study, const EmgOfTrials& emg, StudyActivation& found) {
  if (study.emg.kind == EmgKind::activation) {
    for (std::size_t i = 0; i < emg.size(); ++i) {
      if (emg[i] != nullptr) found.trials[i].activation = *emg[i];
    }
    return;
  }
  found.scale.normalisation = signals::find_normalisation(envelopes_of(study, emg, found, true).trials,
                                                          {.window_s = study.emg.normalise_window_s});
  for (std::size_t i = 0; i < emg.size(); ++i) {
    if (emg[i] == nullptr) continue;
    const auto& stages = found.trials[i].stages;
    found.trials[i].activation =
        thinned(signals::normalise(stages ? stages->envelope : *emg[i], found.scale.normalisation), kActivationRate_hz);
  }
}

StudyActivation study_activation(const Study& study, const EmgOfTrials& emg) {
  StudyActivation found = study_envelopes(study, emg);
  normalise(study, emg, found);
  return found;
}

StudyActivation activation_with_uses(const Study& study,
                                     const EmgOfTrials& emg,
                                     const std::vector<const TrialActivation*>& known) {
  StudyActivation found;
  for (const TrialActivation* trial : known) found.trials.push_back({trial->stages, {}});
  add_envelopes(study, found);
  normalise(study, emg, found);
  return found;
}

}  // namespace myoid
