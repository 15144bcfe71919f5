#include "myoid/methods/exchanged_electrodes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "myoid/beliefs/beliefs.h"
#include "myoid/intervals/score.h"
#include "myoid/math/statistics.h"
#include "myoid/methods/prediction.h"

namespace myoid::identification {
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

double reference_of(const std::map<std::string, double>& references, const std::string& channel) {
  const auto found = references.find(channel);
  return found == references.end() ? 1.0 : found->second;
}

/// Returns the trials with two channels of one trial exchanged, and each channel relative to its largest value.
StudyData with_exchange(const StudyData& data,
                        std::size_t trial,
                        const std::string& first,
                        const std::string& second,
                        const std::map<std::string, double>& references) {
  StudyData exchanged = data;
  const double ratio = reference_of(references, first) / reference_of(references, second);
  std::map<std::string, double> peaks{{first, 0.0}, {second, 0.0}};
  for (std::size_t t = 0; t < data.trials.size(); ++t) {
    const TimeSeries& a = data.trials[t].activation;
    Eigen::MatrixXd values = a.values();
    if (t == trial) {
      values.col(a.index(first)) = a.column(second) / ratio;
      values.col(a.index(second)) = a.column(first) * ratio;
    }
    for (auto& [channel, peak] : peaks) peak = std::max(peak, values.col(a.index(channel)).maxCoeff());
    exchanged.trials[t].activation = TimeSeries(a.time_s(), a.channels(), std::move(values));
  }
  for (TrialData& one : exchanged.trials) {
    Eigen::MatrixXd values = one.activation.values();
    for (const auto& [channel, peak] : peaks) {
      if (peak > 0.0) values.col(one.activation.index(channel)) /= peak;
    }
    one.activation = TimeSeries(one.activation.time_s(), one.activation.channels(), std::move(values));
  }
  return exchanged;
}

}  // namespace

std::string ExchangedElectrodes::sentence() const {
  return fmt::format(
      "with '{}' and '{}' exchanged{} the literature's muscles make the torque to {:.2f} N m rms (R2 {:.2f}), as they "
      "are named only to {:.2f} (R2 {:.2f}): were the two electrodes plugged in or labelled the wrong way round?",
      first, second, trial.empty() ? "" : fmt::format(" in '{}' alone", trial), exchanged.rms_nm, exchanged.r2,
      as_named.rms_nm, as_named.r2);
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
        best = ExchangedElectrodes{channels[i], channels[j], "", now, std::move(fit)};
    }
  }
  return best;
}

std::optional<ExchangedElectrodes> exchanged_in_a_trial(const StudyData& data,
                                                        double delay_s,
                                                        const std::map<std::string, double>& references) {
  constexpr double kDescribes = 0.5, kFar = 1.5;
  StudyData calibration;
  calibration.muscles = data.muscles;
  std::ranges::copy_if(data.trials, std::back_inserter(calibration.trials), &TrialData::calibration);
  if (calibration.trials.size() < 3) return std::nullopt;
  std::vector<std::string> channels;
  for (const MuscleSetup& setup : data.muscles) {
    if (!contains(channels, setup.emg_channel)) channels.push_back(setup.emg_channel);
  }
  const LabelFit now = fit_of_labels(calibration, delay_s);
  if (now.r2 > kDescribes) return std::nullopt;
  std::optional<ExchangedElectrodes> best;
  for (std::size_t t = 0; t < calibration.trials.size(); ++t) {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      for (std::size_t j = i + 1; j < channels.size(); ++j) {
        LabelFit fit = fit_of_labels(with_exchange(calibration, t, channels[i], channels[j], references), delay_s);
        std::vector<double> others = fit.trial_rms_nm;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(t));
        const double here = fit.trial_rms_nm[t];
        if (fit.r2 <= kDescribes || here >= (1.0 - beliefs::kStrengthRatio.sd) * now.trial_rms_nm[t] ||
            here > kFar * math::median(std::move(others)) || fit.rms_nm >= now.rms_nm ||
            (best && fit.rms_nm >= best->exchanged.rms_nm))
          continue;
        best = ExchangedElectrodes{channels[i], channels[j], calibration.trials[t].name, now, std::move(fit)};
      }
    }
  }
  return best;
}

}  // namespace myoid::identification
