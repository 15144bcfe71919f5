#include "myoid/program/commands/twin.h"

#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/output_file.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"
#include "myoid/program/cli/options.h"

namespace myoid::program {
namespace {

namespace fs = std::filesystem;

void make_many(program::TwinPersonsOptions options, const std::string& out, Context& context) {
  context.prepare_folder(out);
  protect_files(out, program::kTwinFiles, {options.twin.protocol});
  options.twin.call = context.call();
  const program::TwinPersonsResult result = program::write_twin_persons(options, out);
  context.end_progress();
  context.log(
      fmt::format("{} persons, seeds {} to {}", options.persons, context.seed, context.seed + options.persons - 1));
  nlohmann::ordered_json studies = nlohmann::ordered_json::array();
  for (const fs::path& study : result.studies) studies.push_back(study.string());
  const std::string table = result.table.string();
  context.print({{"persons", options.persons}, {"table", table}, {"studies", studies}}, table);
}

void make_one(program::TwinOptions options, const std::string& out, Context& context) {
  context.prepare_folder(out);
  protect_files(out, program::kTwinFiles, {options.protocol});
  options.call = context.call();
  const program::TwinResult result = program::twin(options);
  program::write_twin(result, out);
  const lab::VirtualRecording& recording = result.recording;
  context.log(fmt::format("{} trials, level {}, seed {}", recording.trials.size(),
                          choice_name(recording.protocol.level), context.seed));
  const std::string study = (fs::path(out) / "study.toml").string();
  nlohmann::ordered_json trials = nlohmann::ordered_json::array();
  for (const lab::VirtualTrial& trial : recording.trials) trials.push_back(trial.protocol.name);
  context.print({{"study", study}, {"level", choice_name(recording.protocol.level)}, {"trials", trials}}, study);
}

}  // namespace

void add_twin(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("twin",
                          "A virtual recording whose truth is known: markers, raw EMG, model, study.toml, truth.csv.\n"
                          "Example: myoid twin --model arm4 --protocol demo --seed 1 --out rec");
  const auto out = std::make_shared<std::string>();
  const auto options = std::make_shared<program::TwinPersonsOptions>();
  command
      .add_option("--model", options->twin.model,
                  "Model that goes with the recording: arm4 (four muscles, default) or arm7 (seven heads, level L2)")
      ->check(one_of({"arm4", "arm7"}));
  command
      .add_option("--protocol", options->twin.protocol, "Protocol of the recording (.toml), or demo, the program's own")
      ->required();
  command
      .add_option("--level", options->twin.level,
                  "L0 exact, L1 noise, L2 another truth than the model; default: as the protocol says")
      ->check(one_of({"L0", "L1", "L2"}));
  add_truth_option(command, options->twin.truth);
  command
      .add_option("--subjects", options->persons,
                  "So many persons, seeds counting up from --seed, a folder each, and persons.csv")
      ->check(between(1, 1000000));
  command
      .add_option("--format", options->twin.format,
                  "Files of markers and EMG: trc (.trc and .sto, default) or c3d (both in one)")
      ->check(one_of({"trc", "c3d"}));
  command.add_flag("--truth-only", options->truth_only, "With --subjects: persons.csv only, no recordings");
  command.add_option("--out", *out, "Folder for the recording")->required();
  add_common_options(command, context, {.range = false});
  command.callback([&context, &command, options, out] {
    const bool many = command.count("--subjects") > 0;
    if (options->truth_only && !many)
      throw InvalidInput("--truth-only needs --subjects: one person's truth is in truth.csv");
    many ? make_many(*options, *out, context) : make_one(options->twin, *out, context);
  });
}

}  // namespace myoid::program
