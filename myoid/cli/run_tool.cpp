#include "myoid/opensim_tools/run_tool.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/core/json_text.h"

namespace myoid::cli {

void add_run_tool(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "run-tool",
      "Run an OpenSim set-up file: inverse kinematics, inverse dynamics, analyses, scaling\n"
      "Example: myoid run-tool subject01_Setup_IK.xml");
  struct Options {
    std::string setup, compat = "opensim";
    SetupFiles files;
  };
  const auto o = std::make_shared<Options>();
  command.add_option("setup", o->setup, "Set-up file (.xml)")->required();
  command.add_option("--model", o->files.model, "Model (.osim), instead of the set-up's");
  command.add_option(
      "--motion", o->files.motion,
      "Coordinates or states (.mot, .sto), for inverse kinematics and scaling markers "
      "(.trc), instead of the set-up's");
  command.add_option("--external-loads", o->files.external_loads,
                     "External loads (.xml), instead of the set-up's");
  command.add_option("--out", o->files.out, "Folder of the results, instead of the set-up's");
  command
      .add_option("--compat", o->compat,
                  "opensim: paths of muscles as OpenSim 4.5.2 computes them; exact: as their "
                  "geometry is (default opensim)")
      ->check(CLI::IsMember({"opensim", "exact"}));
  add_common_options(command, context, {.seed = false, .range = false, .overwrite = false});
  command.callback([&context, o] {
    const ToolResult result = run_tool(o->setup, {.compat = model::parse_compat(o->compat),
                                                  .files = o->files,
                                                  .progress = context.progress()});
    context.end_progress();
    for (const std::string& note : result.notes) context.warn(note);
    if (result.replaced > 0)
      context.log(fmt::format("{} files of an earlier run are replaced", result.replaced));
    if (context.json) {
      nlohmann::ordered_json json{{"tool", result.tool},
                                  {"summary", result.summary},
                                  {"frames", result.frames},
                                  {"frames_failed", result.frames_failed},
                                  {"notes", result.notes}};
      for (const auto& file : result.files) json["files"].push_back(file.string());
      fmt::print("{}\n", json_text(json));
    } else {
      fmt::print("{}{}{}\n", result.tool, result.summary.empty() ? "" : ": ", result.summary);
      for (const auto& file : result.files) fmt::print("{}\n", file.string());
    }
    if (result.frames_failed > 0 || result.wrong_unit) context.exit_code = kQualityGateFailed;
  });
}

}  // namespace myoid::cli
