#include "myoid/fit/methods/exchanged_electrodes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/fit/intervals/score.h"
#include "myoid/fit/methods/prediction.h"

namespace myoid::fit {
namespace {

constexpr double kCutoff_hz = 1.5;

struct Sides {
  Eigen::VectorXd measured, predicted;
};

/// True if the channel's largest value in one of three calibration trials or more is far above that of all others: with
/// another gain, or as the electrode of another muscle, that trial alone sets what activation 1 is.
bool rests_on_one_trial(const StudyData& data, const std::string& channel) {
  constexpr double kFar = 2.5;
  std::vector<double> peaks;
  for (const TrialData& trial : data.trials) {
    if (trial.calibration) peaks.push_back(trial.activation.column(channel).maxCoeff());
  }
  if (peaks.size() < 3) return false;
  std::ranges::sort(peaks, std::greater<>());
  return peaks[0] > kFar * peaks[1];
}

}  // namespace

std::string ExchangedElectrodes::sentence() const {
  return fmt::format(
      "with '{}' and '{}' exchanged the literature's muscles make the torque to {:.2f} N m rms (R2 {:.2f}), as they "
      "are named only to {:.2f} (R2 {:.2f}): were the two electrodes plugged in or labelled the wrong way round?",
      first, second, exchanged.rms_nm, exchanged.r2, as_named.rms_nm, as_named.r2);
}

LabelFit fit_of_labels(const StudyData& data, double delay_s, const std::string& first, const std::string& second) {
  StudyData named;  // the trials are not changed, and not copied
  named.muscles = data.muscles;
  std::vector<muscle::HillParameters<double>> literature;
  for (MuscleSetup& setup : named.muscles) {
    literature.push_back(setup.start);
    if (setup.emg_channel == first) {
      setup.emg_channel = second;
    } else if (setup.emg_channel == second) {
      setup.emg_channel = first;
    }
  }
  std::vector<std::vector<Sides>> trials;
  double product = 0.0, square = 0.0, sum = 0.0, count = 0.0;
  for (const TrialData& whole : data.trials) {
    if (!whole.calibration) continue;
    trials.emplace_back();
    for (std::size_t j = 0; j < joint_count(whole); ++j) {
      const TrialData trial = of_joint(whole, j);
      const std::vector<Eigen::Index> rows = included_rows(trial);
      if (rows.empty()) continue;
      // No electrode shows the resting torque of the joint.
      const Eigen::VectorXd resting = resting_torque_nm(trial);
      const Eigen::VectorXd active = trial.torque_nm - resting;
      const Eigen::VectorXd torque = predict(named, trial, literature, delay_s).torque_nm - resting;
      Sides sides{below(trial.time_s, active, kCutoff_hz)(rows), below(trial.time_s, torque, kCutoff_hz)(rows)};
      product += sides.predicted.dot(sides.measured);
      square += sides.predicted.squaredNorm();
      sum += sides.measured.sum();
      count += static_cast<double>(rows.size());
      trials.back().push_back(std::move(sides));
    }
  }
  LabelFit fit;
  if (!(count > 0.0)) return fit;
  const double gain = square > 0.0 ? std::max(0.0, product / square) : 0.0;
  double errors = 0.0, total = 0.0;
  for (const std::vector<Sides>& trial : trials) {
    double of_trial = 0.0, samples = 0.0;
    for (const Sides& sides : trial) {
      of_trial += (sides.measured - gain * sides.predicted).squaredNorm();
      total += (sides.measured.array() - sum / count).square().sum();
      samples += static_cast<double>(sides.measured.size());
    }
    errors += of_trial;
    fit.trial_rms_nm.push_back(samples > 0.0 ? std::sqrt(of_trial / samples) : 0.0);
  }
  fit.rms_nm = std::sqrt(errors / count);
  fit.r2 = total > 0.0 ? 1.0 - errors / total : 0.0;
  return fit;
}

std::optional<ExchangedElectrodes> exchanged_electrodes(const StudyData& data, double delay_s) {
  constexpr double kDescribes = 0.5;
  std::vector<std::string> channels;
  for (const MuscleSetup& setup : data.muscles) {
    if (!contains(channels, setup.emg_channel) && !rests_on_one_trial(data, setup.emg_channel))
      channels.push_back(setup.emg_channel);
  }
  const LabelFit now = fit_of_labels(data, delay_s);
  std::optional<ExchangedElectrodes> best;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    for (std::size_t j = i + 1; j < channels.size(); ++j) {
      LabelFit fit = fit_of_labels(data, delay_s, channels[i], channels[j]);
      if (fit.r2 <= kDescribes || fit.rms_nm >= (1.0 - beliefs::kStrengthRatio.sd) * now.rms_nm ||
          (best && fit.rms_nm >= best->exchanged.rms_nm))
        continue;
      std::size_t better = 0;
      for (std::size_t t = 0; t < fit.trial_rms_nm.size(); ++t)
        better += fit.trial_rms_nm[t] < now.trial_rms_nm[t] ? 1 : 0;
      if (4 * better >= 3 * fit.trial_rms_nm.size())
        best = ExchangedElectrodes{channels[i], channels[j], now, std::move(fit)};
    }
  }
  return best;
}

}  // namespace myoid::fit
