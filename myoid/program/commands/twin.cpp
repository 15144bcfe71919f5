#include "myoid/program/commands/twin.h"

#include <atomic>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/lab/virtual_person/demo_protocol.h"
#include "myoid/lab/virtual_person/truth_settings.h"
#include "myoid/program/steps/check_options.h"

namespace myoid::program {
namespace {

namespace fs = std::filesystem;

lab::Protocol protocol_of(const TwinOptions& o) {
  check_options(o);
  lab::Protocol protocol = lab::protocol_named(o.protocol, o.level);
  lab::set_truth(protocol, o.truth);
  protocol.seven_heads = o.seven_heads;
  if (protocol.seven_heads && protocol.level != lab::Level::different) {
    throw InvalidInput(fmt::format(
        "--model arm7 with level {}: only a person at level L2 has seven heads; add --level L2 or choose arm4",
        choice_name(protocol.level)));
  }
  return protocol;
}

lab::WriteOptions write_options(lab::RecordingFormat format) { return {.overwrite = true, .format = format}; }

/// Returns the folder of one person, named by the seed.
fs::path folder_of(const fs::path& out, std::uint64_t seed) { return out / fmt::format("person_{:06}", seed); }

}  // namespace

void visit_protocol(std::string& protocol, study::SettingVisitor& v) {
  v.path("protocol", protocol,
         {.says = "Protocol of the recording (.toml), or demo, the program's own.", .required = "a file"});
}

void visit_truth(std::vector<std::string>& truth, study::SettingVisitor& v) {
  v.texts("truth", truth,
          {.says = "Keys of [truth] in place of the protocol's, KEY=VALUE: moment_arm_sd=0.15 curves=millard."});
}

void visit(TwinOptions& o, study::SettingVisitor& v) {
  static constexpr std::string_view kModels[] = {"arm4", "arm7"};
  v.either("model", o.seven_heads,
           {.says = "Model that goes with the recording: arm4 (four muscles) or arm7 (seven heads, level L2).",
            .words = kModels});
  visit_protocol(o.protocol, v);
  v.choice("level", o.level,
           {.says = "L0 exact, L1 noise, L2 another truth than the model.", .otherwise = "as the protocol says"});
  visit_truth(o.truth, v);
  v.count("subjects", o.persons,
          {.says = "So many persons, seeds counting up from --seed, a folder each, and persons.csv.",
           .limits = study::within(1, 1000000)});
  v.choice("format", o.format, {.says = "Files of markers and EMG: trc (.trc and .sto) or c3d (both in one)."});
  v.flag("truth-only", o.truth_only, {.says = "With --subjects: persons.csv only, no recordings."});
  v.folder("out", o.out, {.says = "Folder for the recording.", .required = "a folder"});
}

std::string truth_help(std::size_t width) { return study::reference_text({lab::truth_reference()}, width); }

TwinResult twin(const TwinOptions& o) {
  if (o.truth_only) throw InvalidInput("--truth-only needs --subjects: one person's truth is in truth.csv");
  return {lab::make_virtual_recording(protocol_of(o), o.call.seed), o.format};
}

void write_twin(const TwinResult& result, const fs::path& folder) {
  lab::write_virtual_recording(result.recording, folder, write_options(result.format));
}

TwinPersonsResult write_twin_persons(const TwinOptions& options, const fs::path& folder) {
  const lab::Protocol protocol = protocol_of(options);
  const Progress& progress = options.call.progress;
  const std::size_t persons = options.persons.value_or(1);
  std::vector<std::string> lines(persons);
  std::atomic<std::size_t> done = 0;
  parallel_each(persons, [&](std::size_t i) {
    progress.check();
    const std::uint64_t seed = options.call.seed + i;
    const lab::VirtualRecording recording =
        options.truth_only ? lab::make_virtual_person(protocol, seed) : lab::make_virtual_recording(protocol, seed);
    if (!options.truth_only)
      lab::write_virtual_recording(recording, folder_of(folder, seed), write_options(options.format));
    lines[i] = lab::truth_row(recording);
    progress.tell(static_cast<double>(++done) / static_cast<double>(persons),
                  fmt::format("{} of {} persons", done.load(), persons));
  });
  std::string table = lab::truth_header() + "\n";
  for (const std::string& line : lines) table += line + "\n";
  TwinPersonsResult result;
  result.table = folder / "persons.csv";
  write_file(result.table, table);
  for (std::size_t i = 0; i < persons && !options.truth_only; ++i)
    result.studies.push_back(folder_of(folder, options.call.seed + i) / "study.toml");
  return result;
}

}  // namespace myoid::program
