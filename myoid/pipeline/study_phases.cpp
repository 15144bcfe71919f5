#include "myoid/pipeline/study_phases.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "myoid/identification/torque.h"
#include "myoid/signals/spectrum.h"

namespace myoid::pipeline {
namespace {

/// Shorter trials hold fewer than the 8 blocks that find_phases wants.
constexpr double kShortest_s = 16.0;

double duration_s(const identification::TrialData& trial) {
  return trial.time_s[trial.time_s.size() - 1] - trial.time_s[0];
}

TimeSeries frequency_of(const StudyResult& result, const TrialResult& trial, double window_s) {
  if (!trial.emg || trial.emg->raw.empty()) return {};
  const TimeSeries& raw = trial.emg->raw;
  signals::MedianFrequencyOptions options{.window_s = window_s};
  if (raw.mean_rate_hz() < 4.0 * options.low_hz || !raw.is_uniform()) return {};
  // The envelope of noise is sqrt(2 / pi) of its root mean square.
  Eigen::VectorXd resting = Eigen::VectorXd::Zero(raw.channel_count());
  for (const signals::ChannelNormalisation& n : result.normalisation) {
    if (const auto column = raw.find(n.channel))
      resting[*column] = n.resting_level_v * std::sqrt(std::numbers::pi / 2.0);
  }
  options.resting_rms = resting;
  return signals::median_frequency(raw, options);
}

}  // namespace

std::vector<TrialPhases> study_phases(const StudyResult& result,
                                      identification::EstimatorOptions options) {
  const identification::StudyData& data = result.data;
  const bool worth_a_fit = std::any_of(data.trials.begin(), data.trials.end(), [](const auto& t) {
    return t.calibration && duration_s(t) >= kShortest_s;
  });
  identification::IdentificationResult fit;
  if (worth_a_fit) {
    options.loss = identification::Loss::huber;
    options.starts = 1;
    options.passes = 2;
    options.intervals = {};
    options.predictions = false;
    options.progress.report = nullptr;
    fit = identification::identify_torque(data, options);
  }
  const PhaseOptions how;
  std::vector<TrialPhases> all;
  for (const identification::TrialData& trial : data.trials) {
    const auto found =
        std::find_if(result.trials.begin(), result.trials.end(),
                     [&](const TrialResult& t) { return t.spec.name == trial.name; });
    const identification::Prediction prediction =
        worth_a_fit ? identification::predict(data, trial, fit.values, options.dynamics)
                    : identification::Prediction{.force_n = {},
                                                 .torque_nm = trial.torque_nm,
                                                 .activation = identification::muscle_activation(
                                                     data, trial, trial.time_s, 0.0)};
    all.push_back({trial.name, find_phases({.time_s = trial.time_s,
                                            .velocity_radps = trial.velocity_radps,
                                            .torque_nm = trial.torque_nm,
                                            .predicted_nm = prediction.torque_nm,
                                            .activation = prediction.activation,
                                            .median_frequency_hz =
                                                worth_a_fit && found != result.trials.end()
                                                    ? frequency_of(result, *found, how.block_s)
                                                    : TimeSeries{}},
                                           how)});
  }
  return all;
}

void exclude_phases(const std::vector<std::string>& rule,
                    std::vector<TrialPhases>& phases,
                    identification::StudyData& data) {
  for (std::size_t i = 0; i < phases.size(); ++i) {
    for (Phase& phase : phases[i].phases) {
      const bool named = std::find(rule.begin(), rule.end(), name(phase.kind)) != rule.end();
      const bool sure = phase.kind != PhaseKind::fatigued || phase.frequency.has_value();
      if (!named || !sure) continue;
      phase.excluded = true;
      data.trials[i].excluded.push_back({phase.begin_s, phase.end_s});
    }
  }
}

}  // namespace myoid::pipeline
