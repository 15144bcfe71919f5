#include "myoid/program/steps/emg.h"

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"

namespace myoid::program {
namespace {

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

void carry_out(Context& context, const EmgOptions& o, const CLI::App& /*command*/) {
  if (o.out.empty()) throw InvalidInput("--out: a name is expected, found none");
  const program::EmgFiles files = program::emg_files(o);
  for (const auto* list : {&files.activations, &files.envelopes})
    for (const std::string& file : *list) context.remember_new_folder(std::filesystem::path(file).parent_path());
  const program::EmgResult result = program::emg(o);
  program::write_emg(result, files);
  context.json ? say_whole(json_text(emg_json(files.activations, result)) + "\n")
               : print_emg(files.activations, result);
}

}  // namespace

void add_emg(CLI::App& app, Context& context) {
  add_command<EmgOptions>(app, context, "emg",
                          "Raw EMG to activation: high-pass, rectify, low-pass, resting level, "
                          "normalized to the largest effort in all files given.\n"
                          "Example: myoid emg flex.sto --mvc mvc.sto --out activation.sto",
                          {.threads = false, .seed = false}, carry_out);
}

}  // namespace myoid::program
