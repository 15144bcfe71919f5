#include "myoid/program/commands/emg.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"
#include "myoid/program/cli/say.h"

namespace myoid::program {
namespace {

struct EmgFlags {
  std::string out, envelope, measures;
  bool no_notch = false;
  bool whitening = false, no_whitening = false;
};

nlohmann::ordered_json emg_json(const std::vector<std::string>& out, const program::EmgResult& result) {
  nlohmann::ordered_json json;
  json["out"] = out.size() == 1 ? nlohmann::ordered_json(out[0]) : nlohmann::ordered_json(out);
  json["whitening"] = {{"applied", result.whitening.applied}, {"reason", result.whitening.reason}};
  json["steps"] = result.chain.steps;
  json["methods"] = result.chain.methods;
  json["channels"] = nlohmann::ordered_json::array();
  for (const auto& n : result.normalisation) {
    json["channels"].push_back({{"channel", n.channel},
                                {"rests", n.rests},
                                {"resting_level_v", n.resting_level_v},
                                {"reference_v", n.reference_v},
                                {"reference_from", n.source_trial},
                                {"reference_time_s", n.source_time_s},
                                {"from_mvc", n.from_mvc}});
  }
  json["measures"] = nlohmann::ordered_json::array();
  for (const program::EmgMeasures& one : result.measures) {
    const auto rows = [](const std::vector<recording::EmgWindow>& windows) {
      nlohmann::ordered_json list = nlohmann::ordered_json::array();
      for (const recording::EmgWindow& w : windows)
        list.push_back({{"begin_s", w.begin_s},
                        {"end_s", w.end_s},
                        {"rms_v", w.rms},
                        {"median_frequency_hz", w.median_frequency_hz}});
      return list;
    };
    json["measures"].push_back(
        {{"file", one.file}, {"channel", one.channel}, {"bursts", rows(one.bursts)}, {"windows", rows(one.windows)}});
  }
  return json;
}

void print_emg(const std::vector<std::string>& out, const program::EmgResult& result) {
  for (const auto& n : result.normalisation) {
    say("{:<24} rest {:>8} uV   1 = {:8.2f} uV  ({} at {:.2f} s{})\n", n.channel,
        n.rests ? fmt::format("{:.2f}", 1e6 * n.resting_level_v) : std::string("unknown"), 1e6 * n.reference_v,
        n.source_trial, n.source_time_s, n.from_mvc ? "" : "; no MVC: relative to the largest effort of these files");
  }
  say("{}: {}\n", result.whitening.applied ? "whitened, all channels" : "not whitened", result.whitening.reason);
  say("For a methods section: {}\n", fmt::join(result.chain.methods, " "));
  for (const std::string& file : out) say("{}\n", file);
}

/// Checks the file of the measures as the other results.
void check_measures(const program::EmgOptions& o,
                    const std::string& measures,
                    std::vector<std::string> others,
                    const std::vector<std::string>& more,
                    bool overwrite) {
  if (measures.empty()) return;
  others.insert(others.end(), more.begin(), more.end());
  for (const std::string& other : others)
    if (other == measures) throw InvalidInput(fmt::format("--measures and another option both name {}", other));
  program::check_emg_files(o, {measures}, {}, overwrite);
}

void run_emg(program::EmgOptions o, const EmgFlags& asked, const Context& context) {
  if (asked.out.empty()) throw InvalidInput("--out: a name is expected, found none");
  const std::vector<std::string> activations = program::emg_files(o.in, asked.out, "--out");
  const std::vector<std::string> envelopes = program::emg_files(o.in, asked.envelope, "--envelope");
  program::check_emg_files(o, activations, envelopes, context.overwrite);
  check_measures(o, asked.measures, activations, envelopes, context.overwrite);
  for (const std::vector<std::string>* files : {&activations, &envelopes})
    for (const std::string& file : *files) context.remember_new_folder(std::filesystem::path(file).parent_path());
  o.chain.notch = !asked.no_notch;
  if (asked.whitening || asked.no_whitening) o.chain.whitening = asked.whitening;
  o.keep_envelopes = !envelopes.empty();
  o.call = context.call();
  const program::EmgResult result = program::emg(o);
  program::write_emg(result, activations, envelopes);
  if (!asked.measures.empty()) program::write_emg_measures(result, asked.measures);
  if (context.json) {
    say_whole(json_text(emg_json(activations, result)) + "\n");
  } else {
    print_emg(activations, result);
  }
}

}  // namespace

void add_emg(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand("emg",
                                          "Raw EMG to activation: high-pass, rectify, low-pass, resting level, "
                                          "normalized to the largest effort in all files given.\n"
                                          "Example: myoid emg flex.sto --mvc mvc.sto --out activation.sto");
  const auto o = std::make_shared<program::EmgOptions>();
  const auto asked = std::make_shared<EmgFlags>();
  command
      .add_option("in", o->in,
                  "EMG (" + emg_endings_text() + "); of several files each is normalized by the largest effort of all")
      ->required();
  command
      .add_option("--out", asked->out,
                  "Activation 0..1 (.sto, .mot or .csv); of several inputs a folder, one .sto each")
      ->required();
  command.add_option(
      "--mvc", o->mvc,
      "Maximal contractions to normalize by, repeated (default: the largest effort in the files themselves)");
  command.add_option("--channel", o->channels, "Only this channel, repeated (default: all of the file's first clock)");
  command.add_option("--unit", o->unit, "Unit of the numbers where the file does not say: V, mV, uV");
  command.add_option("--highpass", o->chain.highpass_hz, "High-pass [Hz] (default 20)")->check(above_zero());
  command
      .add_option("--lowpass", o->chain.lowpass_hz,
                  "Low-pass of the rectified EMG, -3 dB of both passes [Hz] (default 6)")
      ->check(above_zero());
  command.add_flag("--no-notch", asked->no_notch, "Leave mains hum in, where it is found");
  CLI::Option* on = command.add_flag("--whitening", asked->whitening,
                                     "Even out the spectrum of all channels before they are rectified (default: if the "
                                     "files allow it for every channel)");
  command.add_flag("--no-whitening", asked->no_whitening, "Even it out in no channel")->excludes(on);
  command.add_flag("--remove-ecg", o->chain.remove_ecg,
                   "Take the heart out of channels that hold it, as the trunk's do");
  command.add_option("--measures", asked->measures,
                     "Write onset, end, root mean square and median frequency of every burst here (.csv)");
  command
      .add_option("--measure-window", o->measure_window_s,
                  "With --measures also root mean square and median frequency of successive windows this long [s]")
      ->check(above_zero());
  command.add_flag("--as-published", o->chain.as_published,
                   "As the source paper: no high-pass, low-pass designed for one pass");
  command.add_option("--window", o->window_s, "Window of the mean that counts as 1 [s] (default 0.5)")
      ->check(above_zero());
  command.add_option("--envelope", asked->envelope,
                     "Also write the envelope [V] here (.sto, .mot or .csv; or a folder)");
  add_common_options(command, context, {.threads = false, .seed = false});
  command.callback([&context, o, asked] { run_emg(*o, *asked, context); });
}

}  // namespace myoid::program
