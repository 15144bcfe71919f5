#include "myoid/program/steps/emg_input.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/kinematics/motion_plausibility.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/recording/channel_choice.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/signals/clock_gaps.h"
#include "myoid/recording/signals/emg_kind.h"
#include "myoid/recording/signals/emg_quality.h"

namespace myoid::program {
namespace {

std::string channel_in(const std::string& path, const std::string& channel) {
  return fmt::format("{} '{}'", std::filesystem::path(path).filename().string(), channel);
}

/// Returns the defect that prevents filtering or normalization of a channel; empty: none.
std::string defect_of(const TimeSeries& emg, Eigen::Index column) {
  if (std::string gaps = recording::gaps_of(emg, column); !gaps.empty()) return gaps;
  const auto x = emg.values().col(column);
  return x.maxCoeff() > x.minCoeff() ? "" : "has the same value throughout: nothing was connected";
}

/// Selects the channels that can be filtered and normalized. Defective channels are left out with a
/// warning. It is an error if the user named the channels or none remains.
TimeSeries usable_channels(const std::string& path, const TimeSeries& emg, bool asked_for, GroupedWarnings& warnings) {
  constexpr Eigen::Index kFewest = 10;
  if (emg.sample_count() < kFewest)
    throw ReadError(path, 0,
                    fmt::format("only {} {}; at least {} are needed", emg.sample_count(),
                                emg.sample_count() == 1 ? "sample" : "samples", kFewest));
  std::vector<std::string> usable, unusable, defects;
  for (Eigen::Index c = 0; c < emg.channel_count(); ++c) {
    const std::string& name = emg.channels()[static_cast<std::size_t>(c)].name;
    const std::string defect = defect_of(emg, c);
    if (defect.empty()) {
      usable.push_back(name);
    } else {
      unusable.push_back(name);
      defects.push_back(defect);
    }
  }
  std::string all;
  for (std::size_t i = 0; i < defects.size(); ++i) {
    const std::string one = fmt::format("channel '{}' {}", unusable[i], defects[i]);
    all += one + "; ";
    if (!asked_for)
      warnings.add(RemarkCode::channel_unusable, channel_in(path, unusable[i]), defects[i],
                   fmt::format("{}: {}; it is left out", path, one));
  }
  if (!defects.empty() && (asked_for || usable.empty()))
    throw ReadError(path, 0, all + (asked_for ? "ask for others with --channel" : "no other channel is there"));
  return emg.select(usable);
}

/// Keeps the channels that all files have: activation is relative to the largest effort of all.
void keep_common_channels(const std::vector<std::string>& paths,
                          std::vector<TimeSeries>& files,
                          GroupedWarnings& warnings) {
  std::vector<std::string> common;
  for (const Channel& channel : files.front().channels()) {
    const auto lacks = std::ranges::find_if(files, [&](const TimeSeries& file) { return !file.find(channel.name); });
    if (lacks == files.end()) {
      common.push_back(channel.name);
    } else {
      const std::string& other = paths[static_cast<std::size_t>(lacks - files.begin())];
      warnings.add(
          RemarkCode::channel_missing, channel_in(paths.front(), channel.name), other,
          fmt::format(
              "{}: channel '{}' is left out, since {} does not have it (there are {}) or it cannot be used there",
              paths.front(), channel.name, other, channel_names(*lacks)));
    }
  }
  if (common.empty()) throw InvalidInput(fmt::format("no channel is in all files: {}", fmt::join(paths, ", ")));
  for (TimeSeries& file : files) file = file.select(common);
}

/// Warns of faults in raw EMG. Throws ReadError if no channel is raw.
void warn_of_faults(const std::string& path,
                    const TimeSeries& emg,
                    const recording::EnvelopeOptions& chain,
                    GroupedWarnings& warnings) {
  std::vector<std::string> envelopes;
  const std::vector<Remark> faults = recording::check_emg(emg, {.high_passed = !chain.as_published,
                                                                .notched = chain.notch && !chain.as_published,
                                                                .remedies = recording::EmgRemedies::options_of_emg});
  for (const Channel& channel : emg.channels()) {
    if (recording::is_envelope(emg.column(channel.name), emg.mean_rate_hz())) envelopes.push_back(channel.name);
  }
  const std::string what = fmt::format(
      "{} never negative and slow: rectified and smoothed already. This command would turn such an envelope into noise",
      envelopes.size() == 1 ? fmt::format("channel '{}' is", envelopes[0])
                            : fmt::format("channels {} are", fmt::join(envelopes, ", ")));
  if (static_cast<Eigen::Index>(envelopes.size()) == emg.channel_count())
    throw ReadError(path, 0,
                    what +
                        "; give the raw EMG, or divide by the largest effort yourself (a study does it with [emg] kind "
                        "= \"envelope\")");
  if (!envelopes.empty())
    warnings.add(RemarkCode::emg_envelope, path, "envelopes", fmt::format("{}: {}; leave them out", path, what));
  for (const Remark& fault : faults) {
    const bool envelope = std::ranges::find(envelopes, fault.about) != envelopes.end();
    if (fault.severity == Severity::warning && !envelope)
      warnings.add(fault.code, channel_in(path, fault.about), "channels", fmt::format("{}: {}", path, sentence(fault)));
  }
}

/// Returns the samples. Throws ReadError if they are too uneven for the filters.
TimeSeries evenly_spaced(const std::string& path, TimeSeries emg) {
  constexpr double kUneven = 0.2;  // as in the filters
  if (!emg.is_uniform(kUneven))
    throw ReadError(path, 0,
                    "the samples are not evenly spaced, and no filter takes them; export them with an even clock, or "
                    "give them one (myoid convert --rate)");
  return emg;
}

/// Returns the part between two pauses of the recording that holds all times asked for, or all samples where there is
/// no pause. Filters cannot bridge a pause. Throws ReadError where a pause is among the times asked for, and for a
/// clock that is too slow.
TimeSeries between_pauses(const std::string& path, TimeSeries emg, const Call& call, GroupedWarnings& warnings) {
  if (const std::string slow = body::slow_clock(emg.time_s()); !slow.empty()) throw ReadError(path, 0, slow);
  const recording::ClockGaps gaps = recording::find_clock_gaps(emg.time_s());
  if (gaps.count == 0) return evenly_spaced(path, std::move(emg));
  const double begin_s = call.start_s.value_or(-kInfinity), end_s = call.end_s.value_or(kInfinity);
  std::vector<Stretch> asked;
  for (const Stretch& stretch : recording::clock_stretches(emg.time_s(), 2.5 * gaps.usual_interval_s))
    if (begin_s <= stretch.end_s && end_s >= stretch.begin_s) asked.push_back(stretch);
  if (asked.size() != 1)
    throw ReadError(path, 0,
                    fmt::format("the recording pauses ({}), which no filter bridges; choose a part without a pause by "
                                "--start and --end, or save its parts as files of their own",
                                gaps.text()));
  warnings.add(RemarkCode::clock_pause, path, "pauses",
               fmt::format("{}: the recording pauses ({}); its part from {:.6g} to {:.6g} s is taken", path,
                           gaps.text(), asked[0].begin_s, asked[0].end_s));
  return evenly_spaced(path, emg.slice(asked[0].begin_s, asked[0].end_s));
}

/// Reads a file's EMG.
TimeSeries read_raw(const std::string& path, const EmgOptions& o, GroupedWarnings& warnings) {
  recording::EmgFile file = recording::read_emg(path, o.unit, false, o.channels);
  for (const Repair& repair : file.repairs)
    warnings.add(RemarkCode::reading, path, repair.message, fmt::format("{}: {}", path, recording::to_string(repair)));
  if (!file.unit_conflict.empty())
    warnings.add(RemarkCode::unit_doubtful, path, file.unit_conflict, fmt::format("{}: {}", path, file.unit_conflict));
  return usable_channels(path, file.data, !o.channels.empty(), warnings);
}

}  // namespace

GroupedWarnings::~GroupedWarnings() {
  for (Remark& remark : grouped(found_)) remarks_.add(std::move(remark));
}

void GroupedWarnings::add(RemarkCode code, std::string where, std::string about, std::string says) {
  found_.push_back({.code = code, .where = std::move(where), .about = std::move(about), .says = std::move(says)});
}

std::vector<std::string> emg_paths(const EmgOptions& o) {
  std::vector<std::string> paths = o.in;
  paths.insert(paths.end(), o.mvc.begin(), o.mvc.end());
  return paths;
}

std::vector<TimeSeries> read_raw_emg(const EmgOptions& o, GroupedWarnings& warnings) {
  const std::vector<std::string> paths = emg_paths(o);
  std::vector<TimeSeries> raw;
  for (std::size_t i = 0; i < paths.size(); ++i)
    raw.push_back(
        between_pauses(paths[i], read_raw(paths[i], o, warnings), i < o.in.size() ? o.call : Call{}, warnings));
  keep_common_channels(paths, raw, warnings);
  for (std::size_t i = 0; i < raw.size(); ++i) warn_of_faults(paths[i], raw[i], o.chain, warnings);
  return raw;
}

}  // namespace myoid::program
