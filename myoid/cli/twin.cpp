#include <atomic>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/cli/context.h"
#include "myoid/core/error.h"
#include "myoid/core/json_text.h"
#include "myoid/files/atomic_file.h"
#include "myoid/twin/protocol.h"
#include "myoid/twin/write_recording.h"

namespace myoid::cli {
namespace {

namespace fs = std::filesystem;

struct TwinOptions {
  std::string model = "arm4";
  std::string protocol;
  std::string level;
  std::string out;
  std::string format = "trc";
  int subjects = 1;
  bool truth_only = false;
};

twin::Protocol protocol_of(const TwinOptions& options) {
  std::optional<twin::Level> level;
  for (const twin::Level known :
       {twin::Level::noise_free, twin::Level::noisy, twin::Level::different}) {
    if (options.level == twin::name(known)) level = known;
  }
  twin::Protocol protocol = twin::read_protocol(options.protocol, level);
  protocol.seven_heads = options.model == "arm7";
  if (protocol.seven_heads && protocol.level != twin::Level::different) {
    throw InvalidInput(
        fmt::format("--model arm7 with level {}: only a person at level L2 has seven heads; add "
                    "--level L2 or choose arm4",
                    twin::name(protocol.level)));
  }
  return protocol;
}

/// For a folder that `prepare_folder` has looked at.
twin::WriteOptions write_options(const TwinOptions& options) {
  return {
      .overwrite = true,
      .format = options.format == "c3d" ? twin::RecordingFormat::c3d : twin::RecordingFormat::text};
}

/// One person's folder under the common one: seeds make the names.
fs::path folder_of(const fs::path& out, std::uint64_t seed) {
  return out / fmt::format("person_{:06}", seed);
}

/// Many persons, one seed after the other; the table holds a line each.
void make_many(const TwinOptions& options, Context& context) {
  const twin::Protocol protocol = protocol_of(options);
  const fs::path out = options.out;
  context.prepare_folder(out);
  const Progress progress = context.progress();
  const auto count = static_cast<std::size_t>(options.subjects);
  std::vector<std::string> lines(count);
  std::atomic<std::size_t> done = 0;
  oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    progress.check();
    const std::uint64_t seed = context.seed + i;
    const twin::VirtualRecording recording = options.truth_only
                                                 ? twin::make_virtual_person(protocol, seed)
                                                 : twin::make_virtual_recording(protocol, seed);
    if (!options.truth_only)
      twin::write_virtual_recording(recording, folder_of(out, seed), write_options(options));
    lines[i] = twin::truth_row(recording);
    progress.tell(static_cast<double>(++done) / static_cast<double>(count),
                  fmt::format("{} of {} persons", done.load(), count));
  });
  context.end_progress();
  std::string table = twin::truth_header() + "\n";
  for (const std::string& line : lines) table += line + "\n";
  recording::write_file(out / "persons.csv", table);
  context.log(
      fmt::format("{} persons, seeds {} to {}", count, context.seed, context.seed + count - 1));
  if (context.json) {
    nlohmann::ordered_json json;
    json["persons"] = count;
    json["table"] = (out / "persons.csv").string();
    json["studies"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < count && !options.truth_only; ++i)
      json["studies"].push_back((folder_of(out, context.seed + i) / "study.toml").string());
    fmt::print("{}\n", json_text(json));
  } else {
    fmt::print("{}\n", (out / "persons.csv").string());
  }
}

void make_one(const TwinOptions& options, Context& context) {
  const twin::Protocol protocol = protocol_of(options);
  context.prepare_folder(options.out);
  const twin::VirtualRecording recording = twin::make_virtual_recording(protocol, context.seed);
  twin::write_virtual_recording(recording, options.out, write_options(options));
  context.log(fmt::format("{} trials, level {}, seed {}", recording.trials.size(),
                          twin::name(recording.protocol.level), context.seed));
  const std::string study = (fs::path(options.out) / "study.toml").string();
  if (context.json) {
    nlohmann::ordered_json json;
    json["study"] = study;
    json["level"] = twin::name(recording.protocol.level);
    json["trials"] = nlohmann::ordered_json::array();
    for (const twin::VirtualTrial& trial : recording.trials)
      json["trials"].push_back(trial.protocol.name);
    fmt::print("{}\n", json_text(json));
  } else {
    fmt::print("{}\n", study);
  }
}

}  // namespace

void add_twin(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "twin",
      "A virtual recording whose truth is known: markers, raw EMG, model, study.toml, truth.csv.\n"
      "Example: myoid twin --model arm4 --protocol examples/demo/protocol.toml --seed 1 --out rec");
  const auto options = std::make_shared<TwinOptions>();
  command
      .add_option("--model", options->model,
                  "Model that goes with the recording: arm4 (four muscles, default) or arm7 (seven "
                  "heads, level L2)")
      ->check(CLI::IsMember({"arm4", "arm7"}));
  command.add_option("--protocol", options->protocol, "What is recorded, a .toml file")->required();
  command
      .add_option("--level", options->level,
                  "L0 exact, L1 noise, L2 another truth than the model; default: as the protocol "
                  "says")
      ->check(CLI::IsMember({"L0", "L1", "L2"}));
  command
      .add_option("--subjects", options->subjects,
                  "So many persons, seeds counting up from --seed, a folder each, and persons.csv")
      ->check(CLI::Range(1, 1000000));
  command
      .add_option("--format", options->format,
                  "Files of markers and EMG: trc (.trc and .sto, default) or c3d (both in one)")
      ->check(CLI::IsMember({"trc", "c3d"}));
  command.add_flag("--truth-only", options->truth_only,
                   "With --subjects: persons.csv only, no recordings");
  command.add_option("--out", options->out, "Folder for the recording")->required();
  add_common_options(command, context, {.range = false});
  command.callback([&context, &command, options] {
    const bool many = command.count("--subjects") > 0;
    if (options->truth_only && !many)
      throw InvalidInput("--truth-only needs --subjects: one person's truth is in truth.csv");
    many ? make_many(*options, context) : make_one(*options, context);
  });
}

}  // namespace myoid::cli
