#include "myoid/recording/signals/emg_levels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/numbers.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/recording/signals/emg_reference.h"

namespace myoid::recording {
namespace {

/// Extreme means of an envelope: smallest and largest over a pause, and over 0.5 s.
struct Levels {
  double least = kInfinity;
  double peak = 0.0;
  double quietest = kInfinity;
  double greatest = 0.0;
  double greatest_s = 0.0;
  double flatness = 0.0;  ///< `EmgStages::flatness`; 0 if unknown.

  [[nodiscard]] bool rises() const { return greatest > kLimits.noise.rises * quietest; }
};

constexpr double kEffort_s = 0.5;

/// The levels of a channel of trial `number`, without the peaks.
Levels levels(const TimeSeries& envelope, Eigen::Index c, const std::vector<LonePeak>& peaks, std::size_t number) {
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
    if (efforts[i] <= result.greatest || touches(peaks, number, i, wide)) continue;
    result.greatest = efforts[i];
    result.greatest_s = envelope.time_s()[i + wide / 2];
  }
  return result;
}

using LevelsByChannel = std::map<std::string, Levels>;

using PeaksByChannel = std::map<std::string, std::vector<LonePeak>>;

LevelsByChannel levels_of(std::span<const TrialEnvelope> trials, std::size_t number, const PeaksByChannel& peaks) {
  const TrialEnvelope& trial = trials[number];
  LevelsByChannel found;
  for (Eigen::Index c = 0; c < trial.envelope->channel_count(); ++c) {
    const std::string& name = trial.envelope->channels()[static_cast<std::size_t>(c)].name;
    Levels& here = found[name];
    here = levels(*trial.envelope, c, peaks.at(name), number);
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
    if (!(here.greatest > kLimits.levels.other_unit * mvc.greatest) ||
        !(here.least > kLimits.levels.other_unit * mvc.least))
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
LevelsByChannel maximal_levels(std::span<const TrialEnvelope> trials, const PeaksByChannel& peaks) {
  LevelsByChannel maximal;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (!trials[i].is_mvc) continue;
    for (const auto& [channel, here] : levels_of(trials, i, peaks)) {
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
      .where = movement_trial,
      .about = channel,
      .when = Stretch{movement.greatest_s, movement.greatest_s},
      .value = movement.greatest / mvc.greatest,
      .says = fmt::format("channel '{}' reaches {:.2f} times its maximal contraction ({}) in {} at {:.6g} s", channel,
                          movement.greatest / mvc.greatest, mvc_trial, movement_trial, movement.greatest_s),
      .remedy =
          "the contraction was not maximal, or a trial has another gain, which the fit of myoid run tells: the "
          "larger effort counts as 1, and F_max means the force there"};
}

Remark unconfirmed(const std::string& channel, const LonePeak& peak, const std::string& trial) {
  Remark remark{
      .code = RemarkCode::emg_over_reference,
      .severity = Severity::warning,
      .where = trial,
      .about = channel,
      .when = Stretch{peak.begin_s, peak.end_s},
      .value = peak.ratio,
      .says = fmt::format("channel '{}': the half second from {:.6g} s of {}{} is {:.3g} times every other; ", channel,
                          peak.begin_s, trial, peak.at_end ? ", at an end of the recording," : "", peak.ratio)};
  if (peak.replaced) {
    remark.says += "nothing confirms such an effort, and it does not count as 1: the next greatest does";
    remark.remedy =
        "look at it; an artefact there is still in the activation (above 1), so leave that time out; a true effort "
        "that short needs a second one to confirm it";
  } else {
    remark.says += "no other effort is recorded, so that it counts as 1 unconfirmed";
    remark.remedy = "look at it: is it an artefact? Record an effort twice, and for a second";
  }
  return remark;
}

/// Widens the extremes of `all` by those of a trial.
void add(const Levels& here, Levels& all) {
  all.least = std::min(all.least, here.least);
  all.peak = std::max(all.peak, here.peak);
  all.quietest = std::min(all.quietest, here.quietest);
  all.greatest = std::max(all.greatest, here.greatest);
  all.flatness = std::min(all.flatness, here.flatness);
}

Remark low_signal(const std::string& channel, const Levels& all, double greatest_s, std::size_t trials) {
  const bool noise = !all.rises() && all.flatness > kLimits.noise.flatness && all.greatest < kLimits.noise.rms_v;
  const bool works =
      all.rises() && all.flatness > 0.0 && all.flatness <= kLimits.noise.flatness && all.least > kLimits.noise.rms_v;
  const char* const together = trials > 1 ? ", in all trials together" : "";
  Remark remark{.code = RemarkCode::emg_low_signal,
                .severity = noise ? Severity::error : Severity::warning,
                .about = channel,
                .when = Stretch{greatest_s - 0.5 * kEffort_s, greatest_s + 0.5 * kEffort_s},
                .value = all.peak / all.least};
  if (noise) {
    remark.says = fmt::format(
        "channel '{}' never rises and is nothing but noise, {:.2g} uV with the spectrum of an open amplifier{}",
        channel, 1e6 * all.greatest, together);
    remark.remedy = "was the electrode connected? Leave it out";
  } else if (works) {
    remark.severity = Severity::note;
    remark.says = fmt::format("channel '{}' is never below {:.2g} uV{}: its muscle works throughout", channel,
                              1e6 * all.least, together);
    remark.remedy = "no rest was recorded, so that the resting level is unknown: record a second of rest";
  } else {
    remark.says = fmt::format("channel '{}' rises to only {:.2g} times its lowest level{}", channel,
                              all.peak / all.least, together);
    remark.remedy =
        "noise, or a muscle that rests throughout or works throughout: record a second of rest and a strong effort, "
        "and check the electrode";
  }
  return remark;
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
  return quiet[kTrials - 1] <= kLimits.noise.rises * least ? std::optional(least) : std::nullopt;
}

/// True if the channel rises far above `level` in each of three or more other trials, and another channel does in this
/// one: nobody rested.
bool works_elsewhere(const std::string& channel, double level, const LevelsByTrial& trials, std::size_t except) {
  constexpr int kTrials = 3;
  int count = 0;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (i == except) continue;
    const auto found = trials[i].second.find(channel);
    if (found == trials[i].second.end()) continue;
    if (found->second.greatest < kLimits.emg.signal_to_rest * level) return false;
    ++count;
  }
  return count >= kTrials && std::ranges::any_of(trials[except].second, [&](const auto& other) {
           return other.first != channel && other.second.peak > kLimits.emg.signal_to_rest * other.second.least;
         });
}

/// Finds trials in which the electrode of a channel was not on its muscle: the level never rises there, and is neither
/// the resting level of the other trials (a muscle at rest) nor an effort (a spectrum of EMG), or is white noise while
/// the muscle works in all other trials.
void lost_in_trials(const std::string& channel, const LevelsByTrial& trials, std::vector<Remark>& faults) {
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const auto found = trials[i].second.find(channel);
    if (found == trials[i].second.end() || found->second.rises()) continue;
    const Levels& here = found->second;
    const std::optional<double> rest = rest_elsewhere(channel, trials, i);
    const bool white = here.flatness > kLimits.noise.flatness;
    const bool below = rest && here.greatest * kLimits.noise.level < *rest;
    const bool above = rest && here.quietest > kLimits.noise.level * *rest && white;
    const bool silent = white && works_elsewhere(channel, here.greatest, trials, i);
    if (!below && !above && !silent) continue;
    const double over_rest = rest ? here.greatest / *rest : 0.0;
    const std::string level =
        below || above
            ? fmt::format("{} its resting level in the other trials",
                          over_rest < 0.01 ? "less than a hundredth of" : fmt::format("{:.2g} times", over_rest))
            : fmt::format("{:.2g} uV, while its muscle works in all other trials", 1e6 * here.greatest);
    faults.push_back(
        {.code = RemarkCode::emg_low_signal,
         .severity = Severity::warning,
         .about = channel,
         .when = Stretch{here.greatest_s - 0.5 * kEffort_s, here.greatest_s + 0.5 * kEffort_s},
         .value = here.greatest / rest.value_or(here.least),
         .says = fmt::format("channel '{}' in {} is steady noise of {}", channel, trials[i].first->trial, level),
         .remedy = below || above ? "a muscle at rest has the resting level: was the electrode connected there?"
                                  : "was the electrode connected there, or does the muscle rest throughout?"});
  }
}

/// The levels of one trial over the medians of the other trials, at rest and in effort; `least` to `most`.
struct Ratio {
  double least = kInfinity, most = 0.0;

  void add(double ratio) {
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  [[nodiscard]] double mean() const { return std::sqrt(least * most); }
  /// True if all ratios are beyond `limit`, to the same side, and alike.
  [[nodiscard]] bool is_gain(double limit) const {
    return most < kLimits.levels.gain_alike * least && (least > limit || most * limit < 1.0);
  }
};

/// Returns the ratio of a channel; empty unless it rises from rest in this trial and in three others or more.
std::optional<Ratio> ratio_of(const std::string& channel, const LevelsByTrial& trials, std::size_t trial) {
  constexpr std::size_t kTrials = 3;
  std::vector<double> rests, efforts;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const auto found = trials[i].second.find(channel);
    if (found == trials[i].second.end()) continue;
    const bool rises = found->second.greatest > kLimits.emg.signal_to_rest * found->second.quietest;
    if (i == trial && !rises) return std::nullopt;
    if (i == trial || !rises) continue;
    rests.push_back(found->second.quietest);
    efforts.push_back(found->second.greatest);
  }
  if (rests.size() < kTrials) return std::nullopt;
  const Levels& here = trials[trial].second.at(channel);
  Ratio ratio;
  ratio.add(here.quietest / math::median(std::move(rests)));
  ratio.add(here.greatest / math::median(std::move(efforts)));
  return ratio;
}

Remark other_gain(const std::string& trial, const std::string& channel, const Ratio& ratio) {
  return {
      .code = RemarkCode::emg_gain,
      .severity = Severity::warning,
      .about = channel.empty() ? trial : channel,
      .value = ratio.mean(),
      .says = fmt::format("the EMG of trial '{}' is {:.2g} to {:.2g} times that of the other trials in {}, at rest as "
                          "in effort: another gain of the amplifier, or another unit in the file",
                          trial, ratio.least, ratio.most,
                          channel.empty() ? "all channels" : fmt::format("channel '{}' alone", channel)),
      .remedy =
          "correct the numbers in the file, or leave the trial out: every trial's activation rests on the "
          "greatest effort of all"};
}

/// Finds trials whose channels, or one of them, were recorded with another gain; returns their numbers where all were.
std::vector<std::size_t> other_gains(const LevelsByTrial& trials, std::vector<Remark>& faults) {
  std::vector<std::size_t> whole;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    std::map<std::string, Ratio> ratios;
    Ratio all;
    for (const auto& [channel, levels] : trials[i].second) {
      const std::optional<Ratio> ratio = ratio_of(channel, trials, i);
      if (!ratio) continue;
      ratios[channel] = *ratio;
      all.add(ratio->least);
      all.add(ratio->most);
    }
    const std::string& name = trials[i].first->trial;
    if (ratios.size() > 1 && ratios.size() == trials[i].second.size() && all.is_gain(kLimits.levels.gain)) {
      faults.push_back(other_gain(name, "", all));
      whole.push_back(i);
      continue;
    }
    for (const auto& [channel, ratio] : ratios) {
      if (ratio.is_gain(kLimits.levels.gain_alone)) faults.push_back(other_gain(name, channel, ratio));
    }
  }
  return whole;
}

}  // namespace

double time_above_s(const Eigen::Ref<const Eigen::VectorXd>& samples, double rate_hz, double level) {
  const auto count = (samples.array() > level).count();
  return rate_hz > 0.0 ? static_cast<double>(count) / rate_hz : 0.0;
}

std::vector<Remark> check_emg_levels(std::span<const TrialEnvelope> trials) {
  std::vector<Remark> faults;
  std::vector<std::string> names;
  PeaksByChannel peaks;
  for (const TrialEnvelope& trial : trials) {
    for (const Channel& channel : trial.envelope->channels()) {
      if (!peaks.contains(channel.name)) peaks[channel.name] = lone_peaks(trials, channel.name);
    }
  }
  const LevelsByChannel maximal = maximal_levels(trials, peaks);
  LevelsByTrial of_trials;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialEnvelope& trial = trials[i];
    LevelsByChannel own = levels_of(trials, i, peaks);
    if (auto unit = other_unit(trial, own, maximal)) {
      faults.push_back(std::move(*unit));
      continue;
    }
    of_trials.emplace_back(&trial, std::move(own));
    for (const Channel& channel : trial.envelope->channels()) {
      if (std::find(names.begin(), names.end(), channel.name) == names.end()) names.push_back(channel.name);
    }
  }
  const std::vector<std::size_t> scaled = other_gains(of_trials, faults);
  for (auto i = scaled.rbegin(); i != scaled.rend(); ++i)
    of_trials.erase(of_trials.begin() + static_cast<std::ptrdiff_t>(*i));
  for (const std::string& channel : names) {
    for (const LonePeak& peak : peaks.at(channel))
      faults.push_back(unconfirmed(channel, peak, trials[peak.trial].trial));
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
    if (all.peak < kLimits.emg.signal_to_rest * all.least) {
      const Levels& most = movement.greatest >= mvc.greatest ? movement : mvc;
      faults.push_back(low_signal(channel, all, most.greatest_s, of_trials.size()));
    } else {
      lost_in_trials(channel, of_trials, faults);
    }
    if (!mvc_trial.empty() && movement.greatest > kLimits.levels.over_reference * mvc.greatest)
      faults.push_back(above_reference(channel, movement, movement_trial, mvc, mvc_trial));
  }
  return faults;
}

}  // namespace myoid::recording
