#include "myoid/program/commands/convert.h"

#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"
#include "myoid/program/cli/say.h"
#include "myoid/program/commands/stage_input.h"
#include "myoid/results/mat/results_mat.h"

namespace myoid::program {
namespace {

/// Adds the axes of the laboratory and its force plates.
void add_laboratory_options(CLI::App& command, program::ConvertOptions& o) {
  command.option_defaults()->group("Laboratory");
  command
      .add_option("--up", o.up,
                  "Vertical axis of the laboratory, turned to y: x, y, z, -x, -y or -z (default: with force plates as "
                  "the file says, else nothing is turned)")
      ->check(one_of({"x", "y", "z", "-x", "-y", "-z"}));
  command.add_option("--rotate", o.turns, "AXIS:DEGREES, repeated: further turns, one after another");
  command.add_option("--body", o.bodies, "Body of the model that stands on plate 1, 2, ...: writes ExternalLoads too");
  command.add_option("--least-force", o.least_force_n, "Below it a plate counts as unloaded [N] (default 10)")
      ->check(above_zero());
  command.option_defaults()->group("Options");
}

void print_updated(const Context& context, const program::ConvertResult& result) {
  nlohmann::ordered_json notes = nlohmann::ordered_json::array();
  for (const Remark& remark : result.remarks) notes.push_back(sentence(remark));
  const std::string& file = result.files.front();
  context.print({{"file", file}, {"old_version", result.old_version}, {"version", result.version}, {"notes", notes}},
                fmt::format("version {} -> {}\n{}", result.old_version, result.version, file));
}

/// Writes results or a storage file for MATLAB.
void convert_to_mat(const CLI::App& command, const Context& context, const program::ConvertOptions& o) {
  warn_of_idle_options(command, context, {"--overwrite"}, "a MATLAB file");
  results::check_mat_file(o.out);
  context.prepare_file(o.out, {o.in});
  program::Remarks remarks(context.call());
  program::warn_of_repairs(o.in, results::write_results_mat(o.in, o.out), remarks);
  context.print({{"files", {o.out}}}, o.out);
}

/// Converts, and prints the written files.
void run_convert(const CLI::App& command, Context& context, program::ConvertOptions& o) {
  if (std::filesystem::path(o.out).extension() == ".mat") return convert_to_mat(command, context, o);
  const program::Conversion kind = program::conversion_of(o);
  const std::filesystem::path out = o.out;
  if (kind == program::Conversion::derivative) {
    context.prepare_folder(out);
  } else {
    const bool one_file = kind == program::Conversion::opensim_file || out.has_extension();
    context.remember_new_folder(one_file ? out.parent_path() : out);
  }
  if (kind == program::Conversion::opensim_file) {
    warn_of_idle_options(command, context, {"--compat", "--overwrite"}, "an OpenSim file");
  } else if (command.get_option("--compat")->count() > 0) {
    context.warn("--compat has no effect on a recording");
  }
  o.overwrite = context.overwrite;
  o.call = context.call();
  const program::ConvertResult result = program::convert(o);
  if (kind == program::Conversion::opensim_file) {
    print_updated(context, result);
  } else if (context.json) {
    say_whole(json_text({{"files", result.files}}) + "\n");
  } else {
    for (const std::string& file : result.files) say("{}\n", file);
  }
}

}  // namespace

void add_convert(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("convert",
                          "Writes a recording in another format: C3D, TRC, STO/MOT, CSV; EDF, BDF and ANC are read. "
                          "Writes an OpenSim model or set-up of any version in the newest form.\n"
                          "Example: myoid convert walk.c3d walk/ --body calcn_r --body calcn_l");
  const auto o = std::make_shared<program::ConvertOptions>();
  command
      .add_option("in", o->in, endings_text([](const FormatEntry& entry) {
                                 return is_recording(entry.format);
                               }) + ", .osim, .xml, or the folder of a finished run")
      ->required();
  command
      .add_option("out", o->out,
                  ".c3d, .trc, .sto, .mot, .csv, or a folder for everything in it; .osim, .xml of an OpenSim file; "
                  ".mat of a storage file or of the folder of a run")
      ->required();
  command
      .add_option("--what", o->what,
                  "markers, channels, emg (voltages only) or plates; by default markers for .trc, plates for .mot from "
                  ".c3d, else channels")
      ->check(one_of({"markers", "channels", "emg", "plates"}));
  add_laboratory_options(command, *o);
  command.add_option("--unit", o->unit, "Unit of EMG where the file does not say: V, mV, uV");
  command.add_option("--channel", o->channels, "Only this channel, repeated");
  command.add_option("--analog", o->analog, "Channels to go with the markers of a .trc into a .c3d");
  command
      .add_option("--rate", o->rate_hz,
                  "Put everything on an even clock of this rate [Hz]; low-passed first where that is slower (0 dB to "
                  "0.4 of it, -100 dB from half of it on)")
      ->check(above_zero());
  command.add_option("--subject", o->subject,
                     "Label of the person where IN is a folder of results, written as a BIDS derivative (default 01)");
  command
      .add_option("--compat", o->compat,
                  "Of an OpenSim file: exact keeps the digits of the offsets of joints and inertias; opensim rounds "
                  "them to six, as OpenSim converts them (default exact)")
      ->check(one_of({"exact", "opensim"}));
  add_common_options(command, context, {.threads = false, .seed = false});
  command.callback([&command, &context, o] { run_convert(command, context, *o); });
}

}  // namespace myoid::program
