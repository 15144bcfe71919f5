#include "myoid/run/study_phases.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "myoid/fit/measurement/muscle_activation.h"
#include "myoid/fit/measurement/parameters.h"
#include "myoid/fit/measurement/unseen_activations.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/fit/methods/torque.h"
#include "myoid/recording/signals/emg_envelope.h"
#include "myoid/recording/signals/emg_levels.h"
#include "myoid/recording/signals/spectrum.h"
#include "myoid/study/phases/find_phases.h"

namespace myoid::run {
namespace {

/// Shortest trial with the 8 blocks that find_phases needs.
constexpr double kShortest_s = 16.0;

double duration_s(const fit::TrialData& trial) { return trial.time_s[trial.time_s.size() - 1] - trial.time_s[0]; }

TimeSeries frequency_of(const study::EmgScale& scale, const TrialResult& trial, double window_s) {
  if (!trial.emg.stages || trial.emg.stages->raw.empty()) return {};
  const TimeSeries& raw = trial.emg.stages->raw;
  recording::MedianFrequencyOptions options{.window_s = window_s};
  if (raw.mean_rate_hz() < 4.0 * options.low_hz || !raw.is_uniform()) return {};
  // The envelope of noise is sqrt(2 / pi) times its root mean square.
  Eigen::VectorXd resting = Eigen::VectorXd::Zero(raw.channel_count());
  for (const recording::ChannelNormalisation& n : scale.normalisation) {
    if (const auto column = raw.find(n.channel))
      resting[*column] = n.resting_level_v * std::sqrt(std::numbers::pi / 2.0);
  }
  options.resting_rms = resting;
  return recording::median_frequency(raw, options);
}

/// Returns false for a trial that gives its stages without the joint's angle.
bool has_speed(const fit::TrialData& trial) { return trial.velocity_radps.size() == trial.time_s.size(); }

const TrialResult* result_of(const std::vector<TrialResult>& trials, const std::string& name) {
  const auto found = std::ranges::find_if(trials, [&](const TrialResult& t) { return t.spec.name == name; });
  return found == trials.end() ? nullptr : &*found;
}

/// Returns the estimator's data without two effects that would hide fatigue. Fatigue lowers the
/// EMG's frequencies while it raises the amplitude, so that whitening designed for a fresh muscle
/// removes that rise: activations here are not whitened. Only strengths, the delay and the joint
/// are free: a nonlinear law of the EMG could make fresh and tired muscles equal.
fit::StudyData plain_data(const FitSource& source, fit::StudyData data) {
  const study::Study& study = source.study;
  for (const fit::ParameterField& field : fit::parameter_fields()) {
    if (field.scope == fit::Scope::joint || field.name == "max_isometric_force" || field.name == "emg_delay") continue;
    fit::ParameterRule held;
    held.parameter = field.name;
    held.free = false;
    data.rules.push_back(std::move(held));
  }
  if (!source.scale.whitening.applied) return data;

  const recording::EnvelopeOptions& options = study.emg.chain;
  std::vector<const TrialResult*> trials;
  std::vector<study::Use> uses;
  std::vector<TimeSeries> plain;
  for (std::size_t i = 0; i < source.trials.size(); ++i) {
    const TrialResult& trial = source.trials[i];
    if (!trial.emg.stages || trial.emg.stages->filtered.empty()) continue;
    recording::EmgStages stages = *trial.emg.stages;
    recording::add_envelope(stages, options);
    trials.push_back(&trial);
    uses.push_back(study.trials[i].use);
    plain.push_back(std::move(stages.envelope));
  }
  study::ComparedEnvelopes envelopes;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (uses[i] != study::Use::validation)
      envelopes.add({trials[i]->spec.name, uses[i] == study::Use::mvc, &plain[i], trials[i]->emg.stages->bandwidth_hz,
                     Eigen::VectorXd()},
                    trials[i]->spec.exclude.windows);
  }
  const auto normalisation =
      recording::find_normalisation(envelopes.trials, {.window_s = study.emg.normalise_window_s});
  for (fit::TrialData& trial : data.trials) {
    for (std::size_t i = 0; i < trials.size(); ++i) {
      if (trials[i]->spec.name == trial.name) trial.activation = recording::normalise(plain[i], normalisation);
    }
  }
  fit::expect_activations(data);
  return data;
}

}  // namespace

std::vector<study::TrialPhases> study_phases(const FitSource& source,
                                             const fit::StudyData& of_study,
                                             fit::EstimatorOptions options) {
  if (std::ranges::none_of(of_study.trials, has_speed)) return {};
  const bool worth_a_fit = std::ranges::any_of(
      of_study.trials, [](const auto& t) { return t.calibration && has_speed(t) && duration_s(t) >= kShortest_s; });
  const fit::StudyData data = worth_a_fit ? plain_data(source, of_study) : of_study;
  fit::IdentificationResult fit;
  if (worth_a_fit) {
    options.marginals = false;
    options.posterior_draws = 0;
    options.predictions = false;
    options.choose_lag = false;
    options.progress.report = nullptr;
    fit = fit::identify_torque(data, options);
  }
  std::vector<study::TrialPhases> all;
  for (const fit::TrialData& trial : data.trials) {
    if (!has_speed(trial)) {
      all.push_back({trial.name, {}});
      continue;
    }
    study::PhaseSignals signals{
        .time_s = trial.time_s, .velocity_radps = trial.velocity_radps, .torque_nm = trial.torque_nm};
    if (worth_a_fit) {
      fit::Prediction prediction = fit::predict(data, trial, fit.values, options.law);
      signals.predicted_nm = std::move(prediction.torque_nm);
      signals.activation = std::move(prediction.activation);
      if (const TrialResult* found = result_of(source.trials, trial.name))
        signals.median_frequency_hz = frequency_of(source.scale, *found, 0.5 * study::phase_limits::kBlock_s);
    } else {
      signals.predicted_nm = trial.torque_nm;
      signals.activation = fit::muscle_activation(data, trial, 0.0);
    }
    all.push_back({trial.name, study::find_phases(signals)});
  }
  return all;
}

void exclude_phases(const std::vector<study::PhaseKind>& rule,
                    std::vector<study::TrialPhases>& phases,
                    fit::StudyData& data) {
  for (std::size_t i = 0; i < phases.size(); ++i) {
    for (study::Phase& phase : phases[i].phases) {
      const bool named = std::ranges::find(rule, phase.kind) != rule.end();
      const bool sure = phase.kind != study::PhaseKind::fatigued || phase.frequency.has_value();
      if (!named || !sure) continue;
      phase.excluded = true;
      data.trials[i].excluded.push_back({phase.begin_s, phase.end_s});
    }
  }
}

}  // namespace myoid::run
