#include "myoid/commands/run_tool.h"

#include <fmt/format.h>

#include "myoid/cli/context.h"
#include "myoid/cli/option_checks.h"
#include "myoid/cli/say.h"

namespace myoid::cli {

void add_run_tool(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("run-tool",
                          "Run an OpenSim set-up file: inverse kinematics, inverse dynamics, analyses, scaling\n"
                          "Example: myoid run-tool subject01_Setup_IK.xml");
  const auto o = std::make_shared<commands::RunToolOptions>();
  command.add_option("setup", o->setup, "Set-up file (.xml)")->required();
  command.add_option("--model", o->files.model, "Model (.osim), instead of the set-up's");
  command.add_option(
      "--motion", o->files.motion,
      "Coordinates or states (.mot, .sto), for inverse kinematics and scaling markers (.trc), instead of the set-up's");
  command.add_option("--external-loads", o->files.external_loads, "External loads (.xml), instead of the set-up's");
  command.add_option("--out", o->files.out, "Folder of the results, instead of the set-up's");
  command.add_flag("--anywhere", o->anywhere,
                   "Write outside the folder of the set-up too, where the set-up says so (default: refused)");
  command
      .add_option(
          "--compat", o->compat,
          "opensim: paths of muscles as OpenSim 4.5.2 computes them; exact: as their geometry is (default opensim)")
      ->check(one_of({"opensim", "exact"}));
  add_common_options(command, context, {.seed = false, .range = false, .overwrite = false});
  command.callback([&context, o] {
    o->call = context.call();
    const commands::RunToolResult result = commands::run_tool(*o);
    context.end_progress();
    if (context.json) {
      say_whole(run_tool_json(result));
    } else {
      const std::string& summary = result.tool.summary;
      say("{}{}{}\n", result.tool.tool, summary.empty() ? "" : ": ", summary);
      for (const auto& file : result.tool.files) say("{}\n", file.string());
    }
    if (!result.good()) context.exit_code = kQualityGateFailed;
  });
}

}  // namespace myoid::cli
