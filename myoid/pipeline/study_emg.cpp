#include "myoid/pipeline/study_emg.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/pipeline/trial_emg.h"
#include "myoid/signals/emg_levels.h"
#include "myoid/signals/resample.h"

namespace myoid::pipeline {
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

void process_emg_of_trials(const Study& study,
                           const std::vector<TrialInput>& inputs,
                           StudyResult& result) {
  const auto with_emg = [&](std::size_t i) { return inputs[i].emg.has_value(); };
  if (study.emg.kind == EmgKind::raw) {
    const signals::EnvelopeOptions options = envelope_options(study);
    oneapi::tbb::parallel_for(std::size_t{0}, inputs.size(), [&](std::size_t i) {
      if (with_emg(i)) result.trials[i].emg = signals::clean_emg(*inputs[i].emg, options);
    });
    std::vector<const signals::EmgStages*> clean;
    for (const TrialResult& trial : result.trials) {
      if (trial.emg) clean.push_back(&*trial.emg);
    }
    result.whitening = signals::find_whitening(clean, options);
    oneapi::tbb::parallel_for(std::size_t{0}, inputs.size(), [&](std::size_t i) {
      if (with_emg(i)) signals::add_envelope(*result.trials[i].emg, options, result.whitening);
    });
    for (TrialResult& trial : result.trials) {
      if (trial.emg)
        trial.notes.insert(trial.notes.end(), trial.emg->findings.begin(),
                           trial.emg->findings.end());
    }
  }
  if (study.emg.kind == EmgKind::activation) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (with_emg(i)) result.trials[i].activation = *inputs[i].emg;
    }
    return;
  }
  std::vector<signals::TrialEnvelope> envelopes;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!with_emg(i)) continue;
    const TimeSeries& envelope =
        study.emg.kind == EmgKind::raw ? result.trials[i].emg->envelope : *inputs[i].emg;
    envelopes.push_back(
        {study.trials[i].name, study.trials[i].use == Use::mvc, &envelope,
         result.trials[i].emg ? result.trials[i].emg->bandwidth_hz : Eigen::VectorXd()});
  }
  result.level_faults = signals::check_emg_levels(envelopes);
  result.normalisation =
      signals::find_normalisation(envelopes, {.window_s = study.emg.normalise_window_s});
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!with_emg(i)) continue;
    const TimeSeries& envelope =
        study.emg.kind == EmgKind::raw ? result.trials[i].emg->envelope : *inputs[i].emg;
    result.trials[i].activation =
        thinned(signals::normalise(envelope, result.normalisation), kActivationRate_hz);
  }
}

}  // namespace myoid::pipeline
