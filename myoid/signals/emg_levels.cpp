#include "myoid/signals/emg_levels.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/numbers.h"
#include "myoid/math/statistics.h"

namespace myoid::signals {
namespace {

/// Extreme means of an envelope: smallest and largest over a pause, and over 0.5 s.
struct Levels {
  double least = kInfinity;
  double peak = 0.0;
  double quietest = kInfinity;
  double greatest = 0.0;
  double greatest_s = 0.0;
  double flatness = 0.0;  ///< `EmgStages::flatness`; 0 if unknown.

  [[nodiscard]] bool rises() const { return greatest > kLimits.noise_rises * quietest; }
};

constexpr double kEffort_s = 0.5;

Levels levels(const TimeSeries& envelope, Eigen::Index c) {
  Levels result;
  const Eigen::VectorXd x = envelope.values().col(c);
  for (const double mean : math::moving_mean(x, window_samples(envelope, kPause_s))) {
    result.least = std::min(result.least, mean);
    result.peak = std::max(result.peak, mean);
  }
  const Eigen::Index wide = window_samples(envelope, kEffort_s);
  const Eigen::VectorXd efforts = math::moving_mean(x, wide);
  for (Eigen::Index i = 0; i < efforts.size(); ++i) {
    result.quietest = std::min(result.quietest, efforts[i]);
    if (efforts[i] <= result.greatest) continue;
    result.greatest = efforts[i];
    result.greatest_s = envelope.time_s()[i + wide / 2];
  }
  return result;
}

using LevelsByChannel = std::map<std::string, Levels>;

LevelsByChannel levels_of(const TrialEnvelope& trial) {
  LevelsByChannel found;
  for (Eigen::Index c = 0; c < trial.envelope->channel_count(); ++c) {
    Levels& here = found[trial.envelope->channels()[static_cast<std::size_t>(c)].name];
    here = levels(*trial.envelope, c);
    if (c < trial.flatness.size()) here.flatness = trial.flatness[c];
  }
  return found;
}

/// Finds a trial whose channels all exceed the maximal contractions by more than effort can. A contraction that was not
/// maximal leaves rest and the other channels as they are; another unit scales everything.
std::optional<Remark> other_unit(const TrialEnvelope& trial,
                                 const LevelsByChannel& own,
                                 const LevelsByChannel& maximal) {
  double least = kInfinity, most = 0.0;
  for (const auto& [channel, mvc] : maximal) {
    const auto found = own.find(channel);
    if (found == own.end()) continue;
    const Levels& here = found->second;
    if (!(here.greatest > kLimits.other_unit * mvc.greatest) || !(here.least > kLimits.other_unit * mvc.least))
      return std::nullopt;
    least = std::min(least, here.greatest / mvc.greatest);
    most = std::max(most, here.greatest / mvc.greatest);
  }
  if (trial.is_mvc || !(most > 0.0)) return std::nullopt;
  return Remark{
      .code = RemarkCode::emg_over_reference,
      .severity = Severity::error,
      .about = trial.trial,
      .value = most,
      .says = fmt::format(
          "the EMG of trial '{}' reaches {:.3g} to {:.3g} times the maximal contractions in all channels, and is as "
          "much larger at rest: is it in another unit than theirs (a factor of 1000: mV for V, or uV for mV)?",
          trial.trial, least, most),
      .remedy = "correct the unit in the files, or the numbers of that trial"};
}

/// Returns the levels of the maximal contractions, each channel's from its greatest one.
LevelsByChannel maximal_levels(std::span<const TrialEnvelope> trials) {
  LevelsByChannel maximal;
  for (const TrialEnvelope& trial : trials) {
    if (!trial.is_mvc) continue;
    for (const auto& [channel, here] : levels_of(trial)) {
      Levels& most = maximal[channel];
      if (here.greatest > most.greatest) most = here;
    }
  }
  return maximal;
}

Remark above_reference(const std::string& channel,
                       const Levels& movement,
                       const std::string& movement_trial,
                       const Levels& mvc,
                       const std::string& mvc_trial) {
  return {
      .code = RemarkCode::emg_over_reference,
      .severity = Severity::warning,
      .about = channel,
      .when = Stretch{movement.greatest_s, movement.greatest_s},
      .value = movement.greatest / mvc.greatest,
      .says = fmt::format("channel '{}' reaches {:.2f} times its maximal contraction ({}) in {} at {:.6g} s", channel,
                          movement.greatest / mvc.greatest, mvc_trial, movement_trial, movement.greatest_s),
      .remedy = "the contraction was not maximal: the larger effort counts as 1, and F_max means the force there"};
}

/// Widens the extremes of `all` by those of a trial.
void add(const Levels& here, Levels& all) {
  all.least = std::min(all.least, here.least);
  all.peak = std::max(all.peak, here.peak);
  all.quietest = std::min(all.quietest, here.quietest);
  all.greatest = std::max(all.greatest, here.greatest);
  all.flatness = std::min(all.flatness, here.flatness);
}

Remark low_signal(const std::string& channel, const Levels& all, double greatest_s) {
  const bool noise = !all.rises() && all.flatness > kLimits.noise_flatness && all.greatest < kLimits.noise_v;
  return {.code = RemarkCode::emg_low_signal,
          .severity = noise ? Severity::error : Severity::warning,
          .about = channel,
          .when = Stretch{greatest_s - 0.5 * kEffort_s, greatest_s + 0.5 * kEffort_s},
          .value = all.peak / all.least,
          .says = noise ? fmt::format("channel '{}' never rises and is nothing but noise, {:.2g} uV with the spectrum "
                                      "of an open amplifier, in all trials together",
                                      channel, 1e6 * all.greatest)
                        : fmt::format("channel '{}' rises to only {:.2g} times its lowest level, in all trials "
                                      "together",
                                      channel, all.peak / all.least),
          .remedy = noise ? "was the electrode connected? Leave it out"
                          : "noise, or a muscle that neither rests nor works here: record a second of rest and a "
                            "strong effort, and check the electrode"};
}

using LevelsByTrial = std::vector<std::pair<const TrialEnvelope*, LevelsByChannel>>;

/// Returns the resting level of a channel if at least three trials other than `except` agree on it.
std::optional<double> rest_elsewhere(const std::string& channel, const LevelsByTrial& trials, std::size_t except) {
  constexpr int kTrials = 3;
  std::vector<double> quiet;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const auto found = trials[i].second.find(channel);
    if (i != except && found != trials[i].second.end()) quiet.push_back(found->second.quietest);
  }
  if (quiet.size() < kTrials) return std::nullopt;
  std::nth_element(quiet.begin(), quiet.begin() + kTrials - 1, quiet.end());
  const double least = *std::min_element(quiet.begin(), quiet.begin() + kTrials);
  return quiet[kTrials - 1] <= kLimits.noise_rises * least ? std::optional(least) : std::nullopt;
}

/// Finds trials in which the electrode of a channel was not on its muscle: the level never rises there, and is neither
/// the resting level of the other trials (a muscle at rest) nor an effort (a spectrum of EMG).
void lost_in_trials(const std::string& channel, const LevelsByTrial& trials, std::vector<Remark>& faults) {
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const auto found = trials[i].second.find(channel);
    if (found == trials[i].second.end() || found->second.rises()) continue;
    const Levels& here = found->second;
    const std::optional<double> rest = rest_elsewhere(channel, trials, i);
    if (!rest) continue;
    const bool below = here.greatest * kLimits.noise_level < *rest;
    const bool above = here.quietest > kLimits.noise_level * *rest && here.flatness > kLimits.noise_flatness;
    if (!below && !above) continue;
    faults.push_back({.code = RemarkCode::emg_low_signal,
                      .severity = Severity::warning,
                      .about = channel,
                      .when = Stretch{here.greatest_s - 0.5 * kEffort_s, here.greatest_s + 0.5 * kEffort_s},
                      .value = here.greatest / *rest,
                      .says = fmt::format("channel '{}' in {} is steady noise of {:.2g} times its resting level in the "
                                          "other trials",
                                          channel, trials[i].first->trial, here.greatest / *rest),
                      .remedy = "a muscle at rest has the resting level: was the electrode connected there?"});
  }
}

}  // namespace

double time_above_s(const Eigen::Ref<const Eigen::VectorXd>& samples, double rate_hz, double level) {
  const auto count = (samples.array() > level).count();
  return rate_hz > 0.0 ? static_cast<double>(count) / rate_hz : 0.0;
}

std::vector<Remark> check_emg_levels(std::span<const TrialEnvelope> trials) {
  std::vector<Remark> faults;
  std::vector<std::string> names;
  const LevelsByChannel maximal = maximal_levels(trials);
  LevelsByTrial of_trials;
  for (const TrialEnvelope& trial : trials) {
    LevelsByChannel own = levels_of(trial);
    if (auto unit = other_unit(trial, own, maximal)) {
      faults.push_back(std::move(*unit));
      continue;
    }
    of_trials.emplace_back(&trial, std::move(own));
    for (const Channel& channel : trial.envelope->channels()) {
      if (std::find(names.begin(), names.end(), channel.name) == names.end()) names.push_back(channel.name);
    }
  }
  for (const std::string& channel : names) {
    Levels all;
    all.flatness = 1.0;
    Levels mvc;
    Levels movement;
    std::string mvc_trial;
    std::string movement_trial;
    for (const auto& [trial, own] : of_trials) {
      const auto found = own.find(channel);
      if (found == own.end()) continue;
      const Levels& here = found->second;
      add(here, all);
      Levels& most_here = trial->is_mvc ? mvc : movement;
      if (here.greatest <= most_here.greatest) continue;
      most_here = here;
      (trial->is_mvc ? mvc_trial : movement_trial) = trial->trial;
    }
    if (all.peak < kLimits.signal_to_rest * all.least) {
      const Levels& most = movement.greatest >= mvc.greatest ? movement : mvc;
      faults.push_back(low_signal(channel, all, most.greatest_s));
    } else {
      lost_in_trials(channel, of_trials, faults);
    }
    if (!mvc_trial.empty() && movement.greatest > kLimits.over_reference * mvc.greatest)
      faults.push_back(above_reference(channel, movement, movement_trial, mvc, mvc_trial));
  }
  return faults;
}

}  // namespace myoid::signals
