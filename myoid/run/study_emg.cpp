#include "myoid/run/study_emg.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/intake/trial_emg.h"
#include "myoid/signals/emg_levels.h"
#include "myoid/signals/resample.h"

namespace myoid {
namespace {

constexpr double kActivationRate_hz = 200.0;

/// The envelope at no more than `rate_hz`, low-passed for it: splines through it are quicker.
/// Negative values of the filter's undershoot are set to 0.
TimeSeries thinned(const TimeSeries& series, double rate_hz) {
  if (series.mean_rate_hz() < 2.0 * rate_hz) return series;
  const Eigen::VectorXd& t = series.time_s();
  TimeSeries slow = signals::resample(series, signals::even_clock(t[0], t[t.size() - 1], rate_hz));
  return {slow.time_s(), slow.channels(), slow.values().cwiseMax(0.0)};
}

/// How a method's muscles follow their EMG: "delay 43 ms".
std::string delays(const identification::IdentificationResult& method) {
  std::vector<std::string> found;
  for (const identification::ParameterEstimate& e : method.estimates) {
    if (e.parameter == "emg_delay")
      found.push_back(fmt::format("{} {:.1f} ms", e.muscle, 1e3 * e.estimate));
  }
  return found.empty() ? std::string("held by the study")
                       : fmt::format("{}", fmt::join(found, ", "));
}

/// Whether filters and levels of the EMG may rest on each trial: all but those held back for
/// validation, unless that is all of them.
std::vector<bool> seen_trials(const Study& study) {
  std::vector<bool> seen;
  for (const TrialSpec& trial : study.trials) seen.push_back(trial.use != Use::validation);
  if (std::find(seen.begin(), seen.end(), true) == seen.end()) seen.assign(seen.size(), true);
  return seen;
}

/// From clean EMG of each trial on, whose later stages are filled; null: not raw.
StudyActivations activations(const Study& study,
                             const std::vector<TrialInput>& inputs,
                             const std::vector<signals::EmgStages*>& stages) {
  StudyActivations found;
  found.of_trial.resize(inputs.size());
  if (study.emg.kind == EmgKind::activation) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (inputs[i].emg) found.of_trial[i] = *inputs[i].emg;
    }
    return found;
  }
  const std::vector<bool> seen = seen_trials(study);
  const signals::EnvelopeOptions options = envelope_options(study);
  std::vector<const signals::EmgStages*> clean;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (stages[i] != nullptr && seen[i]) clean.push_back(stages[i]);
  }
  if (!clean.empty()) found.whitening = signals::find_whitening(clean, options);
  oneapi::tbb::parallel_for(std::size_t{0}, inputs.size(), [&](std::size_t i) {
    if (stages[i] != nullptr) signals::add_envelope(*stages[i], options, found.whitening);
  });
  const auto envelope = [&](std::size_t i) -> const TimeSeries& {
    return stages[i] != nullptr ? stages[i]->envelope : *inputs[i].emg;
  };
  std::vector<signals::TrialEnvelope> envelopes;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].emg && seen[i])
      envelopes.push_back({study.trials[i].name, study.trials[i].use == Use::mvc, &envelope(i),
                           stages[i] != nullptr ? stages[i]->bandwidth_hz : Eigen::VectorXd()});
  }
  found.normalisation =
      signals::find_normalisation(envelopes, {.window_s = study.emg.normalise_window_s});
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].emg)
      found.of_trial[i] =
          thinned(signals::normalise(envelope(i), found.normalisation), kActivationRate_hz);
  }
  return found;
}

}  // namespace

signals::EmgChain emg_chain(const StudyResult& result,
                            const identification::IdentificationResult* method) {
  const EmgSpec& emg = result.study.emg;
  signals::EmgChain chain;
  std::vector<const signals::EmgStages*> trials;
  bool any = false;
  for (const TrialResult& trial : result.trials) {
    any = any || !trial.activation.empty();
    if (trial.emg) trials.push_back(&*trial.emg);
  }
  if (!any) return chain;
  if (emg.kind == EmgKind::raw) {
    chain = signals::envelope_chain(trials, envelope_options(result.study), result.whitening);
  } else {
    const char* const kind = emg.kind == EmgKind::envelope ? "EMG envelopes" : "activations";
    chain.steps.push_back(fmt::format(
        "{} as the files hold them; how they were made is not known to this program", kind));
    chain.methods.push_back(fmt::format("The input was {} that were processed beforehand.", kind));
  }
  if (emg.kind != EmgKind::activation) {
    signals::add_normalisation(result.normalisation, {.window_s = emg.normalise_window_s}, chain);
    chain.steps.push_back(fmt::format("resampled to {:g} Hz where it has twice that rate or more",
                                      kActivationRate_hz));
  }
  chain.steps.push_back(method == nullptr ? std::string("activation dynamics: none in this file")
                                          : fmt::format("activation dynamics: {}, {} (method {})",
                                                        identification::name(method->lag),
                                                        delays(*method), method->method));
  return chain;
}

StudyActivations activations_without_validation(const Study& study,
                                                const std::vector<TrialInput>& inputs,
                                                const StudyResult& result) {
  std::vector<signals::EmgStages> copies(inputs.size());
  std::vector<signals::EmgStages*> stages(inputs.size(), nullptr);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!result.trials[i].emg) continue;
    copies[i] = *result.trials[i].emg;
    stages[i] = &copies[i];
  }
  return activations(study, inputs, stages);
}

void process_emg_of_trials(const Study& study,
                           const std::vector<TrialInput>& inputs,
                           StudyResult& result) {
  const signals::EnvelopeOptions options = envelope_options(study);
  std::vector<signals::EmgStages*> stages(inputs.size(), nullptr);
  oneapi::tbb::parallel_for(std::size_t{0}, inputs.size(), [&](std::size_t i) {
    if (study.emg.kind != EmgKind::raw || !inputs[i].emg) return;
    stages[i] = &result.trials[i].emg.emplace(signals::clean_emg(*inputs[i].emg, options));
  });
  StudyActivations found = activations(study, inputs, stages);
  std::vector<signals::TrialEnvelope> envelopes;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    TrialResult& trial = result.trials[i];
    trial.activation = std::move(found.of_trial[i]);
    if (trial.emg)
      trial.notes.insert(trial.notes.end(), trial.emg->findings.begin(), trial.emg->findings.end());
    if (inputs[i].emg)
      envelopes.push_back({study.trials[i].name, study.trials[i].use == Use::mvc,
                           trial.emg ? &trial.emg->envelope : &*inputs[i].emg,
                           trial.emg ? trial.emg->bandwidth_hz : Eigen::VectorXd()});
  }
  if (study.emg.kind != EmgKind::activation)
    result.level_faults = signals::check_emg_levels(envelopes);
  result.whitening = std::move(found.whitening);
  result.normalisation = std::move(found.normalisation);
}

}  // namespace myoid
