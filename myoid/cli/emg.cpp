#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/cli/stage_input.h"
#include "myoid/core/error.h"
#include "myoid/pipeline/json_values.h"
#include "myoid/recording/channel_choice.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/series_file.h"
#include "myoid/signals/emg_envelope.h"
#include "myoid/signals/emg_levels.h"
#include "myoid/signals/emg_quality.h"

namespace myoid::cli {
namespace {

/// Why a channel can be neither filtered nor normalized; empty for one that can.
std::string defect_of(const TimeSeries& emg, Eigen::Index column) {
  if (std::string gaps = recording::gaps_of(emg, column); !gaps.empty()) return gaps;
  const auto x = emg.values().col(column);
  return x.maxCoeff() > x.minCoeff() ? "" : "has the same value throughout: nothing was connected";
}

/// The channels that can be filtered and normalized. Another one is left out with a warning; one
/// that was asked for, or the last one, is an error.
TimeSeries usable_channels(const std::string& path,
                           const TimeSeries& emg,
                           bool asked_for,
                           const Context& context) {
  constexpr Eigen::Index kFewest = 10;
  if (emg.sample_count() < kFewest)
    throw ReadError(path, 0,
                    fmt::format("only {} {}; at least {} are needed", emg.sample_count(),
                                emg.sample_count() == 1 ? "sample" : "samples", kFewest));
  std::vector<std::string> usable;
  std::vector<std::string> defects;
  for (Eigen::Index c = 0; c < emg.channel_count(); ++c) {
    const std::string& name = emg.channels()[static_cast<std::size_t>(c)].name;
    const std::string defect = defect_of(emg, c);
    if (defect.empty()) {
      usable.push_back(name);
    } else {
      defects.push_back(fmt::format("channel '{}' {}", name, defect));
    }
  }
  if (!defects.empty() && (asked_for || usable.empty()))
    throw ReadError(
        path, 0,
        fmt::format("{}; {}", fmt::join(defects, "; "),
                    asked_for ? "ask for others with --channel" : "no other channel is there"));
  for (const std::string& defect : defects)
    context.warn(fmt::format("{}: {}; it is left out", path, defect));
  return emg.select(usable);
}

/// The channels that all files have: activation is relative to the largest effort of all.
void keep_common_channels(const std::vector<std::string>& paths,
                          std::vector<TimeSeries>& files,
                          const Context& context) {
  std::vector<std::string> common;
  for (const Channel& channel : files.front().channels()) {
    const auto lacks = std::find_if(files.begin(), files.end(), [&](const TimeSeries& file) {
      return !file.find(channel.name);
    });
    if (lacks == files.end()) {
      common.push_back(channel.name);
    } else {
      context.warn(fmt::format(
          "{}: channel '{}' is left out, since {} does not have it (there are "
          "{}) or it cannot be used there",
          paths.front(), channel.name, paths[static_cast<std::size_t>(lacks - files.begin())],
          channel_names(*lacks)));
    }
  }
  if (common.empty())
    throw InvalidInput(fmt::format("no channel is in all files: {}", fmt::join(paths, ", ")));
  for (TimeSeries& file : files) file = file.select(common);
}

/// Says what is wrong with raw EMG. Throws ReadError if none of it is raw.
void warn_of_faults(const std::string& path,
                    const TimeSeries& emg,
                    bool highpass,
                    const Context& context) {
  std::vector<std::string> envelopes;
  const std::vector<signals::Fault> faults = signals::check_emg(emg, highpass);
  for (const signals::Fault& fault : faults) {
    if (fault.kind == signals::FaultKind::emg_envelope) envelopes.push_back(fault.channel);
  }
  const std::string what = fmt::format(
      "{} never negative and slow: rectified and smoothed already, an envelope, of which this "
      "command would leave noise",
      envelopes.size() == 1 ? fmt::format("channel '{}' is", envelopes[0])
                            : fmt::format("channels {} are", fmt::join(envelopes, ", ")));
  if (static_cast<Eigen::Index>(envelopes.size()) == emg.channel_count())
    throw ReadError(path, 0,
                    what +
                        "; give the raw EMG, or divide by the largest effort yourself (a study "
                        "does it with [emg] kind = \"envelope\")");
  if (!envelopes.empty()) context.warn(fmt::format("{}: {}; leave them out", path, what));
  for (const signals::Fault& fault : faults) {
    const bool envelope =
        std::find(envelopes.begin(), envelopes.end(), fault.channel) != envelopes.end();
    if (fault.grave && !envelope)
      context.warn(fmt::format("{}: {}", path, signals::sentence(fault)));
  }
}

}  // namespace

void add_emg(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("emg",
                          "Raw EMG to activation: high-pass, rectify, low-pass, resting level, "
                          "normalized to the largest effort in the files given.\n"
                          "Example: myoid emg flex.sto --mvc mvc.sto --out activation.sto");
  struct Options {
    std::string in, out, unit, envelope;
    std::vector<std::string> mvc, channels;
    bool no_notch = false;
    bool no_whitening = false;
    signals::EnvelopeOptions chain;
    double window_s = 0.5;
  };
  const auto o = std::make_shared<Options>();
  command.add_option("in", o->in, "EMG (.c3d, .edf, .bdf, .anc, .csv, .sto, .mot)")->required();
  command.add_option("--out", o->out, "Activation 0..1 (.sto, .mot or .csv)")->required();
  command.add_option("--mvc", o->mvc,
                     "Maximal contractions to normalize by, repeated (default: the largest effort "
                     "in the file itself)");
  command.add_option("--channel", o->channels,
                     "Only this channel, repeated (default: all of the file's first clock)");
  command.add_option("--unit", o->unit,
                     "Unit of the numbers where the file does not say: V, mV, uV");
  command.add_option("--highpass", o->chain.highpass_hz, "High-pass [Hz] (default 20)")
      ->check(above_zero());
  command
      .add_option("--lowpass", o->chain.lowpass_hz,
                  "Low-pass of the rectified EMG, -3 dB of both passes [Hz] (default 6)")
      ->check(above_zero());
  command.add_flag("--no-notch", o->no_notch, "Leave mains hum in, where it is found");
  command.add_flag("--no-whitening", o->no_whitening,
                   "Rectify what is high-passed, without evening out its spectrum first");
  command.add_flag("--as-published", o->chain.as_published,
                   "As the source paper: no high-pass, low-pass designed for one pass");
  command
      .add_option("--window", o->window_s, "Window of the mean that counts as 1 [s] (default 0.5)")
      ->check(above_zero());
  command.add_option("--envelope", o->envelope,
                     "Also write the envelope [V] here (.sto, .mot or .csv)");
  add_common_options(command, context, {.threads = false, .seed = false});
  command.callback([&context, o] {
    std::vector<std::string> inputs = o->mvc;
    inputs.push_back(o->in);
    context.prepare_file(o->out, inputs);
    if (!o->envelope.empty()) {
      context.prepare_file(o->envelope, inputs);
      if (o->envelope == o->out)
        throw InvalidInput(fmt::format("--out and --envelope both name {}", o->out));
    }
    const auto read = [&](const std::string& path) {
      recording::EmgFile file = recording::read_emg(path, o->unit, false, o->channels);
      for (const recording::Repair& repair : file.repairs)
        context.warn(fmt::format("{}: {}", path, recording::to_string(repair)));
      if (!file.unit_conflict.empty())
        context.warn(fmt::format("{}: {}", path, file.unit_conflict));
      return usable_channels(path, file.data, !o->channels.empty(), context);
    };
    std::vector<std::string> paths{o->in};
    paths.insert(paths.end(), o->mvc.begin(), o->mvc.end());
    std::vector<TimeSeries> raw;
    for (const std::string& path : paths) raw.push_back(read(path));
    keep_common_channels(paths, raw, context);
    o->chain.notch = !o->no_notch;
    o->chain.whitening = !o->no_whitening;
    std::vector<signals::EmgStages> stages;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      warn_of_faults(paths[i], raw[i], !o->chain.as_published, context);
      stages.push_back(signals::clean_emg(raw[i], o->chain));
    }
    std::vector<const signals::EmgStages*> views;
    for (const signals::EmgStages& one : stages) views.push_back(&one);
    const auto whitening = signals::find_whitening(views, o->chain);
    std::vector<signals::TrialEnvelope> trials;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      signals::add_envelope(stages[i], o->chain, whitening);
      for (const std::string& finding : stages[i].findings)
        context.log(fmt::format("{}: {}", paths[i], finding));
      trials.push_back({paths[i], i > 0, &stages[i].envelope, stages[i].bandwidth_hz});
    }
    for (const signals::WhiteningFilter& filter : whitening) {
      context.log(
          filter.reason.empty()
              ? fmt::format("channel '{}': whitened, statistical bandwidth {:.0f} -> {:.0f} Hz",
                            filter.channel, filter.bandwidth_before_hz, filter.bandwidth_after_hz)
              : fmt::format("channel '{}' is not whitened: {}", filter.channel, filter.reason));
    }
    const TimeSeries& envelope = stages.front().envelope;
    const auto normalisation = signals::find_normalisation(trials, {.window_s = o->window_s});
    for (const signals::Fault& fault : signals::check_emg_levels(trials)) {
      if (fault.grave) context.warn(signals::sentence(fault));
    }
    recording::write_series(o->out, cut(signals::normalise(envelope, normalisation), context),
                            "Activation");
    if (!o->envelope.empty())
      recording::write_series(o->envelope, cut(envelope, context), "EMG envelope volt");
    if (context.json) {
      nlohmann::ordered_json json{{"out", o->out}};
      json["channels"] = nlohmann::ordered_json::array();
      for (const auto& n : normalisation) {
        json["channels"].push_back({{"channel", n.channel},
                                    {"resting_level_v", n.resting_level_v},
                                    {"reference_v", n.reference_v},
                                    {"reference_from", n.source_trial},
                                    {"reference_time_s", n.source_time_s},
                                    {"from_mvc", n.from_mvc}});
      }
      fmt::print("{}\n", pipeline::json_text(json));
      return;
    }
    for (const auto& n : normalisation) {
      fmt::print("{:<24} rest {:8.2f} uV   1 = {:8.2f} uV  ({} at {:.2f} s{})\n", n.channel,
                 1e6 * n.resting_level_v, 1e6 * n.reference_v, n.source_trial, n.source_time_s,
                 n.from_mvc ? "" : "; no MVC: relative to this file's largest effort");
    }
    fmt::print("{}\n", o->out);
  });
}

}  // namespace myoid::cli
