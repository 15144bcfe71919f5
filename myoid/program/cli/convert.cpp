#include "myoid/program/steps/convert.h"

#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"
#include "myoid/program/steps/stage_input.h"
#include "myoid/results/mat/results_mat.h"

namespace myoid::program {
namespace {

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
  prepare_mat(context, o.out, {o.in});
  program::Remarks remarks(o.call);
  program::warn_of_repairs(o.in, results::write_results_mat(o.in, o.out), remarks);
  context.print({{"files", {o.out}}}, o.out);
}

/// Converts, and prints the written files.
void carry_out(Context& context, const ConvertOptions& o, const CLI::App& command) {
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
  add_command<ConvertOptions>(
      app, context, "convert",
      "Writes a recording in another format: C3D, TRC, STO/MOT, CSV; EDF, BDF and ANC are read. "
      "Writes an OpenSim model or set-up of any version in the newest form.\n"
      "Example: myoid convert walk.c3d walk/ --body calcn_r --body calcn_l",
      {.threads = false, .seed = false}, carry_out);
}

}  // namespace myoid::program
