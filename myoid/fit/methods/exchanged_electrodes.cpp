#include "myoid/fit/methods/exchanged_electrodes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "myoid/fit/intervals/score.h"
#include "myoid/fit/intervals/verdict_rules.h"
#include "myoid/fit/methods/cross_validation.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/fit/posterior/exploration.h"

namespace myoid::fit {
namespace {

constexpr double kCutoff_hz = 1.5;

struct Sides {
  Eigen::VectorXd measured, predicted;
};

constexpr double kFar = 2.5;           // standard deviations of a muscle's number
constexpr std::size_t kMostPairs = 4;  // that are tried

/// An EMG channel, and the greatest distance of its muscles' numbers from what is known of people.
struct FarChannel {
  std::string name;
  double distance = 0.0;
};

std::vector<FarChannel> far_channels(const StudyData& data, const IdentificationResult& fit) {
  std::vector<FarChannel> channels;
  for (const MuscleSetup& setup : data.muscles) {
    auto at = std::ranges::find(channels, setup.emg_channel, &FarChannel::name);
    if (at == channels.end()) at = channels.insert(channels.end(), {setup.emg_channel});
    const auto known = std::ranges::find(fit.prior_distances, setup.name, &PriorDistance::muscle);
    if (known != fit.prior_distances.end()) at->distance = std::max(at->distance, known->farthest_distance);
  }
  return channels;
}

/// Two channels, in the order in which they are tried: those farthest first.
struct ChannelPair {
  std::string first, second;
  double distance = 0.0;
};

std::vector<ChannelPair> doubtful_pairs(const StudyData& data, const IdentificationResult& fit) {
  const std::vector<FarChannel> channels = far_channels(data, fit);
  std::vector<ChannelPair> pairs;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    for (std::size_t j = i + 1; j < channels.size(); ++j) {
      const FarChannel &a = channels[i], &b = channels[j];
      if (std::max(a.distance, b.distance) < kFar && fit.r2 > kVerdictRules.least_r2) continue;
      pairs.push_back({a.name, b.name, a.distance + b.distance});
    }
  }
  std::ranges::stable_sort(pairs, std::ranges::greater(), &ChannelPair::distance);
  if (pairs.size() > kMostPairs) pairs.resize(kMostPairs);
  return pairs;
}

/// Returns ln of the evidence of the heaviest mode.
double log_evidence(const StudyData& data, const EstimatorOptions& options) {
  return explore(data, options).modes.front().mode.log_evidence;
}

}  // namespace

std::string ExchangedElectrodes::sentence() const {
  return fmt::format(
      "with '{}' and '{}' exchanged the recording is 10^{:.0f} times as probable: were the two electrodes plugged in "
      "or "
      "labelled the wrong way round?",
      first, second, log_odds / std::numbers::ln10);
}

LabelFit fit_of_labels(const StudyData& data, double lead_s) {
  std::vector<muscle::HillParameters<double>> literature;
  for (const MuscleSetup& setup : data.muscles) literature.push_back(setup.start);
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
      const Eigen::VectorXd torque = predict(data, trial, literature, lead_s).torque_nm - resting;
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

std::optional<ExchangedElectrodes> exchanged_electrodes(const StudyData& data,
                                                        const EstimatorOptions& options,
                                                        const IdentificationResult& fit) {
  const std::vector<ChannelPair> pairs = fit.noise.size() > 0 ? doubtful_pairs(data, fit) : std::vector<ChannelPair>{};
  if (pairs.empty()) return std::nullopt;
  EstimatorOptions plain = remembering_drives(of_a_fold(options));
  plain.law = fit.lag;
  plain.choose_lag = false;
  const double as_named = log_evidence(data, beginning_at(fit, plain));
  std::optional<ExchangedElectrodes> best;
  for (const ChannelPair& pair : pairs) {
    StudyData other = data;
    for (MuscleSetup& setup : other.muscles) {
      if (setup.emg_channel == pair.first) {
        setup.emg_channel = pair.second;
      } else if (setup.emg_channel == pair.second) {
        setup.emg_channel = pair.first;
      }
    }
    const double odds = log_evidence(other, plain) - as_named;
    if (odds > (best ? best->log_odds : kExchangedOdds)) best = {pair.first, pair.second, odds, fit.r2};
  }
  return best;
}

}  // namespace myoid::fit
