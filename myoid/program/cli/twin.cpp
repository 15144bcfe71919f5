#include "myoid/program/commands/twin.h"

#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/files/output_file.h"
#include "myoid/program/cli/command_help.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"

namespace myoid::program {
namespace {

namespace fs = std::filesystem;

void make_many(const program::TwinOptions& options, Context& context) {
  const program::TwinPersonsResult result = program::write_twin_persons(options, options.out);
  context.end_progress();
  context.log(
      fmt::format("{} persons, seeds {} to {}", *options.persons, context.seed, context.seed + *options.persons - 1));
  nlohmann::ordered_json studies = nlohmann::ordered_json::array();
  for (const fs::path& study : result.studies) studies.push_back(study.string());
  const std::string table = result.table.string();
  context.print({{"persons", *options.persons}, {"table", table}, {"studies", studies}}, table);
}

void make_one(const program::TwinOptions& options, Context& context) {
  const program::TwinResult result = program::twin(options);
  program::write_twin(result, options.out);
  const lab::VirtualRecording& recording = result.recording;
  context.log(fmt::format("{} trials, level {}, seed {}", recording.trials.size(),
                          choice_name(recording.protocol.level), context.seed));
  const std::string study = (fs::path(options.out) / "study.toml").string();
  nlohmann::ordered_json trials = nlohmann::ordered_json::array();
  for (const lab::VirtualTrial& trial : recording.trials) trials.push_back(trial.protocol.name);
  context.print({{"study", study}, {"level", choice_name(recording.protocol.level)}, {"trials", trials}}, study);
}

void carry_out(Context& context, const TwinOptions& o, const CLI::App& /*command*/) {
  context.prepare_folder(o.out);
  protect_files(o.out, program::kTwinFiles, {o.protocol});
  o.persons ? make_many(o, context) : make_one(o, context);
}

}  // namespace

void add_twin(CLI::App& app, Context& context) {
  add_command<TwinOptions>(app, context, "twin",
                           "A virtual recording whose truth is known: markers, raw EMG, model, study.toml, truth.csv.\n"
                           "Example: myoid twin --model arm4 --protocol demo --seed 1 --out rec",
                           {.range = false}, carry_out)
      ->footer([] { return program::truth_help(help_width()); });
}

}  // namespace myoid::program
