#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/cli/stage_input.h"
#include "myoid/core/error.h"
#include "myoid/core/finding.h"
#include "myoid/core/json_text.h"
#include "myoid/recording/channel_choice.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/recording.h"
#include "myoid/signals/emg_chain.h"
#include "myoid/signals/emg_envelope.h"
#include "myoid/signals/emg_levels.h"
#include "myoid/signals/emg_quality.h"
#include "myoid/tables/series_file.h"

namespace myoid::cli {
namespace {

/// Warnings of a command; what is alike in several channels or files is said once.
class Warnings {
 public:
  explicit Warnings(const Context& context) : context_(context) {}
  Warnings(const Warnings&) = delete;
  Warnings& operator=(const Warnings&) = delete;
  ~Warnings() {
    for (const Finding& f : grouped(found_)) context_.warn(f.message);
  }

  /// `where` names the file or channel where the same `kind` is not the first one.
  void add(std::string where, std::string message, std::string kind) {
    found_.push_back({Finding::Level::warning, std::move(where), std::move(message), std::nullopt,
                      std::move(kind)});
  }

 private:
  const Context& context_;
  std::vector<Finding> found_;
};

std::string channel_in(const std::string& path, const std::string& channel) {
  return fmt::format("{} '{}'", std::filesystem::path(path).filename().string(), channel);
}

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
                           Warnings& warnings) {
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
      warnings.add(channel_in(path, unusable[i]), fmt::format("{}: {}; it is left out", path, one),
                   "unusable " + defects[i]);
  }
  if (!defects.empty() && (asked_for || usable.empty()))
    throw ReadError(
        path, 0, all + (asked_for ? "ask for others with --channel" : "no other channel is there"));
  return emg.select(usable);
}

/// The channels that all files have: activation is relative to the largest effort of all.
void keep_common_channels(const std::vector<std::string>& paths,
                          std::vector<TimeSeries>& files,
                          Warnings& warnings) {
  std::vector<std::string> common;
  for (const Channel& channel : files.front().channels()) {
    const auto lacks = std::find_if(files.begin(), files.end(), [&](const TimeSeries& file) {
      return !file.find(channel.name);
    });
    if (lacks == files.end()) {
      common.push_back(channel.name);
    } else {
      const std::string& other = paths[static_cast<std::size_t>(lacks - files.begin())];
      warnings.add(channel_in(paths.front(), channel.name),
                   fmt::format("{}: channel '{}' is left out, since {} does not have it (there are "
                               "{}) or it cannot be used there",
                               paths.front(), channel.name, other, channel_names(*lacks)),
                   "not in " + other);
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
                    Warnings& warnings) {
  std::vector<std::string> envelopes;
  const std::vector<Fault> faults = signals::check_emg(emg, highpass);
  for (const Fault& fault : faults) {
    if (fault.kind == FaultKind::emg_envelope) envelopes.push_back(fault.channel);
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
  if (!envelopes.empty())
    warnings.add(path, fmt::format("{}: {}; leave them out", path, what), "envelopes");
  for (const Fault& fault : faults) {
    const bool envelope =
        std::find(envelopes.begin(), envelopes.end(), fault.channel) != envelopes.end();
    if (fault.grave && !envelope)
      warnings.add(channel_in(path, fault.channel), fmt::format("{}: {}", path, sentence(fault)),
                   std::string(name(fault.kind)));
  }
}

void warn_of_levels(const std::vector<signals::TrialEnvelope>& trials, const Context& context) {
  Warnings warnings(context);
  for (const Fault& fault : signals::check_emg_levels(trials)) {
    if (fault.grave)
      warnings.add(fmt::format("'{}'", fault.channel), sentence(fault),
                   std::string(name(fault.kind)));
  }
}

struct EmgCommand {
  std::vector<std::string> in, mvc, channels;
  std::string out, unit, envelope;
  bool no_notch = false;
  bool whitening = false, no_whitening = false;
  signals::EnvelopeOptions chain;
  double window_s = 0.5;
};

/// What goes where: with one input `to` is the file, with several the folder of files of the
/// inputs' names. Throws InvalidInput where two would be one.
std::vector<std::string> outputs(const EmgCommand& o, const std::string& to, const char* option) {
  if (to.empty()) return {};
  if (o.in.size() == 1) return {to};
  std::vector<std::string> files;
  for (const std::string& path : o.in) {
    const std::string name = std::filesystem::path(path).stem().string() + ".sto";
    files.push_back((std::filesystem::path(to) / name).string());
    if (std::count(files.begin(), files.end(), files.back()) > 1)
      throw InvalidInput(
          fmt::format("two inputs would be written to {}: rename one of them, or "
                      "give them to two commands with every --mvc",
                      files.back()));
  }
  const std::string ending = std::filesystem::path(to).extension().string();
  if (!ending.empty() && !std::filesystem::is_directory(to))
    throw InvalidInput(
        fmt::format("{} {}: of {} inputs this is a folder, found a name that ends "
                    "in '{}'",
                    option, to, o.in.size(), ending));
  return files;
}

/// Refuses output files that are there or are inputs, or each other.
void prepare(const EmgCommand& o,
             const std::vector<std::string>& activations,
             const std::vector<std::string>& envelopes,
             const Context& context) {
  std::vector<std::string> inputs = o.mvc;
  inputs.insert(inputs.end(), o.in.begin(), o.in.end());
  for (const std::string& file : activations) context.prepare_file(file, inputs);
  for (const std::string& file : envelopes) {
    context.prepare_file(file, inputs);
    if (std::find(activations.begin(), activations.end(), file) != activations.end())
      throw InvalidInput(fmt::format("--out and --envelope both name {}", file));
  }
}

/// All files of the command, cleaned, whitened by one decision and smoothed.
struct EmgFiles {
  std::vector<std::string> paths;  ///< The inputs, then the maximal contractions.
  std::vector<signals::EmgStages> stages;
  signals::Whitening whitening;

  [[nodiscard]] std::vector<const signals::EmgStages*> views() const {
    std::vector<const signals::EmgStages*> list;
    for (const signals::EmgStages& one : stages) list.push_back(&one);
    return list;
  }
};

/// Reads a file's EMG.
TimeSeries read_raw(const std::string& path, const EmgCommand& o, Warnings& warnings) {
  recording::EmgFile file = recording::read_emg(path, o.unit, false, o.channels);
  for (const recording::Repair& repair : file.repairs)
    warnings.add(path, fmt::format("{}: {}", path, recording::to_string(repair)), repair.message);
  if (!file.unit_conflict.empty())
    warnings.add(path, fmt::format("{}: {}", path, file.unit_conflict), file.unit_conflict);
  return usable_channels(path, file.data, !o.channels.empty(), warnings);
}

EmgFiles process(const EmgCommand& o, const Context& context) {
  Warnings warnings(context);
  EmgFiles files;
  files.paths = o.in;
  files.paths.insert(files.paths.end(), o.mvc.begin(), o.mvc.end());
  std::vector<TimeSeries> raw;
  for (const std::string& path : files.paths) raw.push_back(read_raw(path, o, warnings));
  keep_common_channels(files.paths, raw, warnings);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    warn_of_faults(files.paths[i], raw[i], !o.chain.as_published, warnings);
    files.stages.push_back(signals::clean_emg(raw[i], o.chain));
  }
  files.whitening = signals::find_whitening(files.views(), o.chain);
  for (std::size_t i = 0; i < files.paths.size(); ++i) {
    signals::add_envelope(files.stages[i], o.chain, files.whitening);
    for (const std::string& finding : files.stages[i].findings)
      context.log(fmt::format("{}: {}", files.paths[i], finding));
  }
  for (const signals::WhiteningFilter& filter : files.whitening.filters) {
    if (filter.reason.empty())
      context.log(fmt::format("channel '{}': statistical bandwidth {:.0f} Hz, whitened {:.0f} Hz",
                              filter.channel, filter.bandwidth_before_hz,
                              filter.bandwidth_after_hz));
  }
  return files;
}

nlohmann::ordered_json emg_json(const std::vector<std::string>& out,
                                const EmgFiles& files,
                                const std::vector<signals::ChannelNormalisation>& normalisation,
                                const signals::EmgChain& chain) {
  nlohmann::ordered_json json;
  json["out"] = out.size() == 1 ? nlohmann::ordered_json(out[0]) : nlohmann::ordered_json(out);
  json["whitening"] = {{"applied", files.whitening.applied}, {"reason", files.whitening.reason}};
  json["steps"] = chain.steps;
  json["methods"] = chain.methods;
  json["channels"] = nlohmann::ordered_json::array();
  for (const auto& n : normalisation) {
    json["channels"].push_back({{"channel", n.channel},
                                {"rests", n.rests},
                                {"resting_level_v", n.resting_level_v},
                                {"reference_v", n.reference_v},
                                {"reference_from", n.source_trial},
                                {"reference_time_s", n.source_time_s},
                                {"from_mvc", n.from_mvc}});
  }
  return json;
}

void print_emg(const std::vector<std::string>& out,
               const EmgFiles& files,
               const std::vector<signals::ChannelNormalisation>& normalisation,
               const signals::EmgChain& chain) {
  for (const auto& n : normalisation) {
    fmt::print("{:<24} rest {:>8} uV   1 = {:8.2f} uV  ({} at {:.2f} s{})\n", n.channel,
               n.rests ? fmt::format("{:.2f}", 1e6 * n.resting_level_v) : std::string("unknown"),
               1e6 * n.reference_v, n.source_trial, n.source_time_s,
               n.from_mvc ? "" : "; no MVC: relative to the largest effort of these files");
  }
  fmt::print("{}: {}\n", files.whitening.applied ? "whitened, all channels" : "not whitened",
             files.whitening.reason);
  fmt::print("For a methods section: {}\n", fmt::join(chain.methods, " "));
  for (const std::string& file : out) fmt::print("{}\n", file);
}

void run_emg(EmgCommand o, const Context& context) {
  if (o.out.empty()) throw InvalidInput("--out: a name is expected, found none");
  const std::vector<std::string> activations = outputs(o, o.out, "--out");
  const std::vector<std::string> envelopes = outputs(o, o.envelope, "--envelope");
  prepare(o, activations, envelopes, context);
  o.chain.notch = !o.no_notch;
  if (o.whitening || o.no_whitening) o.chain.whitening = o.whitening;
  const EmgFiles files = process(o, context);
  std::vector<signals::TrialEnvelope> trials;
  for (std::size_t i = 0; i < files.paths.size(); ++i) {
    trials.push_back({files.paths[i], i >= o.in.size(), &files.stages[i].envelope,
                      files.stages[i].bandwidth_hz});
  }
  const signals::NormalisationOptions window{.window_s = o.window_s};
  const auto normalisation = signals::find_normalisation(trials, window);
  warn_of_levels(trials, context);
  signals::EmgChain chain = signals::envelope_chain(files.views(), o.chain, files.whitening);
  const std::vector<std::string> of_envelope = signals::header_lines(chain);
  signals::add_normalisation(normalisation, window, chain);
  chain.steps.emplace_back("activation dynamics: none in this file");
  const std::vector<std::string> of_activation = signals::header_lines(chain);
  for (std::size_t i = 0; i < o.in.size(); ++i) {
    const TimeSeries& envelope = files.stages[i].envelope;
    recording::write_series(activations[i],
                            cut(signals::normalise(envelope, normalisation), context), "Activation",
                            of_activation);
    if (!envelopes.empty())
      recording::write_series(envelopes[i], cut(envelope, context), "EMG envelope volt",
                              of_envelope);
  }
  if (context.json) {
    fmt::print("{}\n", json_text(emg_json(activations, files, normalisation, chain)));
  } else {
    print_emg(activations, files, normalisation, chain);
  }
}

}  // namespace

void add_emg(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("emg",
                          "Raw EMG to activation: high-pass, rectify, low-pass, resting level, "
                          "normalized to the largest effort in all files given.\n"
                          "Example: myoid emg flex.sto --mvc mvc.sto --out activation.sto");
  const auto o = std::make_shared<EmgCommand>();
  command
      .add_option("in", o->in,
                  "EMG (.c3d, .edf, .bdf, .anc, .csv, .sto, .mot); of several files each is "
                  "normalized by the largest effort of all")
      ->required();
  command
      .add_option("--out", o->out,
                  "Activation 0..1 (.sto, .mot or .csv); of several inputs a folder, one .sto each")
      ->required();
  command.add_option("--mvc", o->mvc,
                     "Maximal contractions to normalize by, repeated (default: the largest effort "
                     "in the files themselves)");
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
  CLI::Option* on = command.add_flag(
      "--whitening", o->whitening,
      "Even out the spectrum of all channels before they are rectified (default: if the files "
      "allow it for every channel)");
  command.add_flag("--no-whitening", o->no_whitening, "Even it out in no channel")->excludes(on);
  command.add_flag("--as-published", o->chain.as_published,
                   "As the source paper: no high-pass, low-pass designed for one pass");
  command
      .add_option("--window", o->window_s, "Window of the mean that counts as 1 [s] (default 0.5)")
      ->check(above_zero());
  command.add_option("--envelope", o->envelope,
                     "Also write the envelope [V] here (.sto, .mot or .csv; or a folder)");
  add_common_options(command, context, {.threads = false, .seed = false});
  command.callback([&context, o] { run_emg(*o, context); });
}

}  // namespace myoid::cli
