#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/cli/stage_input.h"
#include "myoid/core/error.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/series_file.h"
#include "myoid/signals/emg_envelope.h"
#include "myoid/signals/emg_levels.h"
#include "myoid/signals/emg_quality.h"

namespace myoid::cli {
namespace {

/// What can be filtered and normalized at all.
void require_emg(const std::string& path, const TimeSeries& emg) {
  constexpr Eigen::Index kFewest = 10;
  if (emg.sample_count() < kFewest)
    throw ReadError(path, 0,
                    fmt::format("only {} {}; at least {} are needed", emg.sample_count(),
                                emg.sample_count() == 1 ? "sample" : "samples", kFewest));
  for (Eigen::Index c = 0; c < emg.channel_count(); ++c) {
    const auto x = emg.values().col(c);
    if (x.maxCoeff() > x.minCoeff()) continue;
    throw ReadError(
        path, 0,
        fmt::format("channel '{}' has the same value throughout: nothing was connected; "
                    "leave the column out",
                    emg.channels()[static_cast<std::size_t>(c)].name));
  }
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
    std::vector<std::string> mvc;
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
    const auto clean = [&](const std::string& path) {
      recording::EmgFile file = recording::read_emg(path, o->unit, false);
      for (const recording::Repair& repair : file.repairs)
        context.warn(fmt::format("{}: {}", path, recording::to_string(repair)));
      if (!file.unit_conflict.empty())
        context.warn(fmt::format("{}: {}", path, file.unit_conflict));
      require_emg(path, file.data);
      o->chain.notch = !o->no_notch;
      o->chain.whitening = !o->no_whitening;
      warn_of_faults(path, file.data, !o->chain.as_published, context);
      return signals::clean_emg(file.data, o->chain);
    };
    std::vector<std::string> paths{o->in};
    paths.insert(paths.end(), o->mvc.begin(), o->mvc.end());
    std::vector<signals::EmgStages> stages;
    for (const std::string& path : paths) stages.push_back(clean(path));
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
      fmt::print("{}\n", json.dump(2));
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
