#include "myoid/program/commands/twin.h"

#include <atomic>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/lab/twin/write_recording.h"
#include "myoid/lab/virtual_person/demo_protocol.h"
#include "myoid/lab/virtual_person/truth_settings.h"
#include "myoid/program/commands/stage_input.h"

namespace myoid::program {
namespace {

namespace fs = std::filesystem;

lab::Protocol protocol_of(const TwinOptions& o) {
  check_word("--model", o.model, {"arm4", "arm7"});
  check_word("--format", o.format, {"trc", "c3d"});
  lab::Protocol protocol = lab::protocol_named(o.protocol, level_named(o.level));
  lab::set_truth(protocol, o.truth);
  protocol.seven_heads = o.model == "arm7";
  if (protocol.seven_heads && protocol.level != lab::Level::different) {
    throw InvalidInput(fmt::format(
        "--model arm7 with level {}: only a person at level L2 has seven heads; add --level L2 or choose arm4",
        choice_name(protocol.level)));
  }
  return protocol;
}

lab::WriteOptions write_options(const std::string& format) {
  return {.overwrite = true, .format = format == "c3d" ? lab::RecordingFormat::c3d : lab::RecordingFormat::text};
}

/// Returns the folder of one person, named by the seed.
fs::path folder_of(const fs::path& out, std::uint64_t seed) { return out / fmt::format("person_{:06}", seed); }

}  // namespace

std::optional<lab::Level> level_named(const std::string& name) {
  if (name.empty()) return std::nullopt;
  check_word("--level", name, {"L0", "L1", "L2"});
  return choice_named<lab::Level>(name);
}

std::string truth_help(std::size_t width) { return study::reference_text({lab::truth_reference()}, width); }

TwinResult twin(const TwinOptions& o) { return {lab::make_virtual_recording(protocol_of(o), o.call.seed), o.format}; }

void write_twin(const TwinResult& result, const fs::path& folder) {
  lab::write_virtual_recording(result.recording, folder, write_options(result.format));
}

TwinPersonsResult write_twin_persons(const TwinPersonsOptions& options, const fs::path& folder) {
  const lab::Protocol protocol = protocol_of(options.twin);
  const Progress& progress = options.twin.call.progress;
  std::vector<std::string> lines(options.persons);
  std::atomic<std::size_t> done = 0;
  oneapi::tbb::parallel_for(std::size_t{0}, options.persons, [&](std::size_t i) {
    progress.check();
    const std::uint64_t seed = options.twin.call.seed + i;
    const lab::VirtualRecording recording =
        options.truth_only ? lab::make_virtual_person(protocol, seed) : lab::make_virtual_recording(protocol, seed);
    if (!options.truth_only)
      lab::write_virtual_recording(recording, folder_of(folder, seed), write_options(options.twin.format));
    lines[i] = lab::truth_row(recording);
    progress.tell(static_cast<double>(++done) / static_cast<double>(options.persons),
                  fmt::format("{} of {} persons", done.load(), options.persons));
  });
  std::string table = lab::truth_header() + "\n";
  for (const std::string& line : lines) table += line + "\n";
  TwinPersonsResult result;
  result.table = folder / "persons.csv";
  write_file(result.table, table);
  for (std::size_t i = 0; i < options.persons && !options.truth_only; ++i)
    result.studies.push_back(folder_of(folder, options.twin.call.seed + i) / "study.toml");
  return result;
}

}  // namespace myoid::program
