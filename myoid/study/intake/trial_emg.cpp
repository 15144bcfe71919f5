#include "myoid/study/intake/trial_emg.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/amplifier_range.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/signals/emg_kind.h"
#include "myoid/recording/signals/emg_levels.h"
#include "myoid/recording/signals/resample.h"
#include "myoid/study/intake/clock_check.h"
#include "myoid/study/intake/emg_cover.h"
#include "myoid/study/intake/limits.h"
#include "myoid/study/intake/trial_clock.h"
#include "myoid/study/intake/trial_quality.h"

namespace myoid::study {
namespace {

/// Renames channels by the muscle under the electrode (EMG-BIDS), where the study names its EMG so.
void name_by_target_muscle(const Study& study,
                           const std::filesystem::path& path,
                           recording::EmgFile& file,
                           std::vector<Remark>& remarks) {
  std::vector<Channel> channels = file.data.channels();
  bool renamed = false;
  for (const MuscleSpec& muscle : study.muscles) {
    if (muscle.without_emg || file.data.find(muscle.emg)) continue;
    std::vector<std::size_t> targets;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const auto it = file.target_muscle.find(channels[c].name);
      if (it != file.target_muscle.end() && equal_ignoring_case(it->second, muscle.emg)) targets.push_back(c);
    }
    if (targets.size() != 1) continue;
    add_notes(
        {fmt::format("{}: channel '{}' is on {}", path.filename().string(), channels[targets[0]].name, muscle.emg)},
        remarks);
    channels[targets[0]].name = muscle.emg;
    renamed = true;
  }
  if (renamed) file.data = TimeSeries(file.data.time_s(), std::move(channels), file.data.values());
}

/// Returns the channels of the study that are not on the first clock of their file, each clock once.
std::vector<TimeSeries> on_other_clocks(const Study& study,
                                        const std::filesystem::path& path,
                                        const recording::EmgFile& file) {
  std::vector<TimeSeries> found;
  for (const MuscleSpec& muscle : study.muscles) {
    const auto has = [&](const TimeSeries& s) { return s.find(muscle.emg).has_value(); };
    if (muscle.without_emg || has(file.data) || std::ranges::any_of(found, has)) continue;
    try {
      TimeSeries one = recording::read_emg(path, study.emg.unit, study.emg.kind != EmgKind::raw, {muscle.emg}).data;
      if (has(one)) found.push_back(std::move(one));
    } catch (const ReadError&) {
      continue;  // require_channels lists the available channels
    }
  }
  return found;
}

/// Puts the study's channels on one clock, that of the fastest channel, over the time that all have.
void join_clocks(const Study& study,
                 const std::filesystem::path& path,
                 recording::EmgFile& file,
                 std::vector<Remark>& remarks) {
  std::vector<TimeSeries> parts = on_other_clocks(study, path, file);
  if (parts.empty()) return;
  std::vector<std::string> here;
  for (const MuscleSpec& muscle : study.muscles) {
    if (file.data.find(muscle.emg) && std::ranges::find(here, muscle.emg) == here.end()) here.push_back(muscle.emg);
  }
  if (!here.empty()) parts.insert(parts.begin(), file.data.select(here));
  double begin_s = -1e300, end_s = 1e300;
  const TimeSeries* fastest = &parts.front();
  for (const TimeSeries& part : parts) {
    require_finite(part, path.string());
    if (part.sample_count() < 2) return;
    begin_s = std::max(begin_s, part.time_s()[0]);
    end_s = std::min(end_s, part.time_s()[part.sample_count() - 1]);
    if (part.mean_rate_hz() > fastest->mean_rate_hz()) fastest = &part;
  }
  const Eigen::VectorXd clock = fastest->slice(begin_s, end_s).time_s();
  if (clock.size() < 2)
    throw ReadError(
        path, 0,
        fmt::format("channels {} and {} have no time in common; give the muscles channels that were recorded together",
                    channel_names(parts.front()), channel_names(parts.back())));
  std::vector<Channel> channels;
  Eigen::MatrixXd values(clock.size(), 0);
  for (const TimeSeries& part : parts) {
    const TimeSeries moved = &part == fastest ? part.slice(begin_s, end_s) : recording::resample(part, clock);
    values.conservativeResize(Eigen::NoChange, values.cols() + moved.channel_count());
    values.rightCols(moved.channel_count()) = moved.values();
    channels.insert(channels.end(), moved.channels().begin(), moved.channels().end());
    if (&part != fastest)
      add_notes(
          {fmt::format("{}: {} at {:.6g} Hz put on the clock of {}, {:.6g} Hz", path.filename().string(),
                       channel_names(part), part.mean_rate_hz(), channel_names(*fastest), fastest->mean_rate_hz())},
          remarks);
  }
  file.data = TimeSeries(clock, std::move(channels), std::move(values));
}

void require_channels(const Study& study, const std::filesystem::path& path, const TimeSeries& emg) {
  for (const MuscleSpec& muscle : study.muscles) {
    if (muscle.without_emg || emg.find(muscle.emg)) continue;
    std::vector<std::string> names;
    for (const Channel& channel : emg.channels()) names.push_back(channel.name);
    throw ReadError(path, 0,
                    fmt::format("no EMG channel '{}' for muscle {}; found {}{}; rename the column of this file or, if "
                                "all files name it so, correct "
                                "[[muscle]] emg in the study",
                                muscle.emg, muscle.name, channel_names(emg), did_you_mean(muscle.emg, names)));
  }
}

/// Refuses raw EMG that is an envelope, which a high-pass would reduce to noise, or that is not an electrode's signal.
void require_raw(const Study& study, const std::filesystem::path& path, const TimeSeries& emg) {
  int envelopes = 0;
  int others = 0;
  std::vector<std::string> no_volts;
  for (const MuscleSpec& muscle : study.muscles) {
    const auto column = emg.find(muscle.emg);
    if (!column || !emg.values().col(*column).allFinite()) continue;
    const auto x = emg.values().col(*column);
    if (x.cwiseAbs().maxCoeff() > kLimits.emg.no_converter_v)
      throw ReadError(path, 0,
                      fmt::format("channel '{}' reaches {:.3g} V, beyond any converter; correct [emg] unit, or leave "
                                  "out samples that are no measurement",
                                  muscle.emg, x.cwiseAbs().maxCoeff()));
    if (recording::is_beyond_amplifiers(x) && std::ranges::find(no_volts, muscle.emg) == no_volts.end())
      no_volts.push_back(muscle.emg);
    if (x.maxCoeff() > x.minCoeff()) ++(recording::is_envelope(x, emg.mean_rate_hz()) ? envelopes : others);
  }
  // Equal words for every trial make one remark of all trials.
  if (!no_volts.empty())
    throw ReadError(path, 0,
                    fmt::format("{}: more than {:g} % of the samples lie beyond {:g} V, and no amplifier gives that: "
                                "the numbers are not in V; say what they are by [emg] unit = \"uV\" or \"mV\"",
                                fmt::join(no_volts, ", "), 100.0 * recording::kShareBeyond, recording::kMostVolts));
  if (envelopes > 0 && others == 0)
    throw ReadError(path, 0,
                    "no channel is ever negative or goes up and down as raw EMG does: these are envelopes; set [emg] "
                    "kind = \"envelope\"");
}

/// Refuses signals that are no envelopes or activations. Raw EMG, which swings about zero, and
/// signals in other units would give muscle forces a hundred times too large without a message.
void require_kind(const Study& study, const std::filesystem::path& path, const TimeSeries& emg, TrialInput& input) {
  if (study.emg.kind == EmgKind::raw) return require_raw(study, path, emg);
  const bool activation = study.emg.kind == EmgKind::activation;
  const char* const kind = activation ? "activation" : "envelope";
  for (const MuscleSpec& muscle : study.muscles) {
    const auto column = emg.find(muscle.emg);
    if (!column) continue;
    const Unit in = emg.channels()[static_cast<std::size_t>(*column)].unit;
    const std::string unit = in == Unit::dimensionless ? "(the file's own numbers)" : std::string(symbol(in));
    double low = 0.0;
    double high = 0.0;
    for (const double value : emg.values().col(*column)) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    if (low < -kLimits.emg.below_zero * high)
      throw ReadError(path, 0,
                      fmt::format("channel '{}' reaches from {:.3g} to {:.3g} {}, but [emg] kind = \"{}\" is never "
                                  "below zero; is it raw EMG? Then set kind = \"raw\"",
                                  muscle.emg, low, high, unit, kind));
    const bool lasting = recording::time_above_s(emg.values().col(*column), emg.mean_rate_hz(),
                                                 kLimits.emg.largest_activation) >= kLimits.emg.spike_s;
    if (activation && high > kLimits.emg.largest_activation && !lasting)
      warn(
          input, RemarkCode::emg_artifact,
          fmt::format("{}: channel '{}' reaches {:.3g}, above {:g} for less than {:g} s: an artefact?",
                      path.filename().string(), muscle.emg, high, kLimits.emg.largest_activation, kLimits.emg.spike_s));
    if (activation && lasting)
      throw ReadError(path, 0,
                      fmt::format("channel '{}' reaches {:.3g}, but an activation goes from 0 to 1; percent? Divide by "
                                  "100, or set [emg] kind = \"envelope\"",
                                  muscle.emg, high));
  }
}

/// Returns the EMG on the clock of the motion, and describes the steps.
TimeSeries on_clock_of_motion(
    const Study& study, const TrialSpec& trial, TimeSeries emg, const Remember& remember, TrialInput& input) {
  const auto envelopes = [&] {
    recording::EnvelopeOptions options = study.emg.chain;
    options.whitening = false;  // this pass serves only the clock of one trial
    return study.emg.kind == EmgKind::raw ? recording::process_emg(emg, options).envelope : emg;
  };
  input.emg_clock = trial_clock(study, trial, movement_of(input), envelopes, remember);
  if (!input.emg_clock) return emg;
  add_notes({fmt::format("{}: clock put on that of the motion, {} ({})", trial.emg->filename().string(),
                         recording::to_string(input.emg_clock->clock), input.emg_clock->source)},
            input.remarks);
  return recording::on_study_clock(std::move(emg), input.emg_clock->clock);
}

}  // namespace

TimeSeries read_trial_emg(const Study& study, const TrialSpec& trial, const Remember& remember, TrialInput& input) {
  const double start = trial.start_s.value_or(-1e300);
  const double end = trial.end_s.value_or(1e300);
  recording::EmgFile file = recording::read_emg(*trial.emg, study.emg.unit, study.emg.kind != EmgKind::raw);
  add_repairs(*trial.emg, file.repairs, input.remarks);
  if (!file.unit_conflict.empty())
    warn(input, RemarkCode::unit_doubtful, "EMG: " + file.unit_conflict);  // the same words in every trial
  name_by_target_muscle(study, *trial.emg, file, input.remarks);
  join_clocks(study, *trial.emg, file, input.remarks);
  require_channels(study, *trial.emg, file.data);
  require_kind(study, *trial.emg, file.data, input);
  std::vector<std::string> wanted;
  for (const MuscleSpec& muscle : study.muscles) {
    if (!muscle.without_emg && std::ranges::find(wanted, muscle.emg) == wanted.end()) wanted.push_back(muscle.emg);
  }
  // The EMG may begin earlier than the motion, because of the delay.
  TimeSeries emg = on_clock_of_motion(study, trial, file.data.select(wanted), remember, input);
  // `join_given_clocks` compares the clock of activations with that of given lengths.
  const bool given = trial.given.lengths && study.emg.kind == EmgKind::activation;
  if (!given) emg = emg.slice(start - 0.5, end);
  require_finite(emg, trial.emg->string());
  if (given) return emg;
  if (emg.sample_count() < kLeastOfATrial) throw ReadError(*trial.emg, 0, few_samples(trial, emg));
  if (std::string pauses = check_clock(*trial.emg, emg.time_s()); !pauses.empty())
    warn(input, RemarkCode::clock_pause, std::move(pauses));
  if (const auto cover = check_cover(*trial.emg, "EMG", emg.time_s(), trial, input))
    warn(input, RemarkCode::emg_cover,
         fmt::format("{}: those seconds are not fitted. If both were recorded together, {}; else start_s and end_s "
                     "leave the rest out",
                     cover->lacks,
                     cover->as_long ? "their clocks begin apart: [sync] offset_s moves that of the EMG"
                                    : "the rate of one of them is wrong, or the EMG is another trial's"));
  return emg;
}

}  // namespace myoid::study
