#include "myoid/program/commands/convert.h"

#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"
#include "myoid/program/cli/say.h"

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

}  // namespace

void add_convert(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("convert",
                          "Writes a recording in another format: C3D, TRC, STO/MOT, CSV; EDF, BDF and ANC are read.\n"
                          "Example: myoid convert walk.c3d walk/ --body calcn_r --body calcn_l");
  const auto o = std::make_shared<program::ConvertOptions>();
  command
      .add_option("in", o->in, endings_text([](const FormatEntry& entry) {
                                 return is_recording(entry.format);
                               }) + ", or the folder of a finished run")
      ->required();
  command.add_option("out", o->out, ".c3d, .trc, .sto, .mot, .csv, or a folder for everything in it")->required();
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
  add_common_options(command, context, {.threads = false, .seed = false});
  command.callback([&context, o] {
    if (program::makes_derivative(*o)) {
      context.prepare_folder(o->out);
    } else {
      const std::filesystem::path out = o->out;
      context.remember_new_folder(out.has_extension() ? out.parent_path() : out);
    }
    o->overwrite = context.overwrite;
    o->call = context.call();
    const program::ConvertResult result = program::convert(*o);
    if (context.json) {
      say_whole(json_text({{"files", result.files}}) + "\n");
    } else {
      for (const std::string& file : result.files) say("{}\n", file);
    }
  });
}

}  // namespace myoid::program
