#include "myoid/program/commands/run_tool.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/counted.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"
#include "myoid/program/cli/say.h"
#include "myoid/program/commands/run_tools.h"

namespace myoid::program {
namespace {

using program::SetupOutcome;
using program::SetupStatus;

void run_one(const program::RunToolOptions& options, Context& context) {
  const program::RunToolResult result = program::run_tool(options);
  context.end_progress();
  if (context.json) {
    say_whole(run_tool_json(result));
  } else {
    const std::string& summary = result.tool.summary;
    say("{}{}{}\n", result.tool.tool, summary.empty() ? "" : ": ", summary);
    for (const auto& file : result.tool.files) say("{}\n", file.string());
  }
  if (!result.good()) context.exit_code = kQualityGateFailed;
}

/// A row a set-up, and the number of each status below.
void print_table(const std::vector<SetupOutcome>& outcomes) {
  std::size_t width = 6;
  for (const SetupOutcome& each : outcomes) width = std::max(width, in_column(each.setup).size());
  say("{:<{}}  {:<14}  {:<24}  {:>6}  {:>10}\n", "set-up", width, "status", "tool", "frames", "not solved");
  for (const SetupOutcome& each : outcomes) {
    const opensim::ToolResult& tool = each.result.tool;
    if (each.status >= SetupStatus::failed) {
      say("{:<{}}  {:<14}  {}\n", in_column(each.setup), width, status_word(each.status), each.message);
    } else {
      say("{:<{}}  {:<14}  {:<24}  {:>6}  {:>10}{}\n", in_column(each.setup), width, status_word(each.status),
          tool.tool, tool.frames, tool.frames_failed, tool.wrong_unit ? "  the unit of the markers is wrong" : "");
    }
  }
  const auto done = std::ranges::count(outcomes, SetupStatus::done, &SetupOutcome::status);
  say("\n{} of {} done\n", done, counted(outcomes.size(), "set-up"));
}

void run_several(program::RunToolsOptions options, Context& context) {
  options.heard = [&context](const SetupOutcome& each) {
    if (each.status < SetupStatus::failed) return;
    context.end_progress();
    context.warn(fmt::format("{} {}: {}", each.setup, status_word(each.status), each.message));
  };
  const std::vector<SetupOutcome> outcomes = program::run_tools(options);
  context.end_progress();
  if (context.json)
    say_whole(run_tools_json(outcomes));
  else
    print_table(outcomes);
  const auto any = [&](SetupStatus least) {
    return std::ranges::any_of(outcomes, [&](const SetupOutcome& each) { return each.status >= least; });
  };
  if (any(SetupStatus::failed))
    context.exit_code = kSomeTrialsFailed;
  else if (any(SetupStatus::gate_failed))
    context.exit_code = kQualityGateFailed;
}

}  // namespace

void add_run_tool(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("run-tool",
                          "Run OpenSim set-up files: inverse kinematics, inverse dynamics, analyses, scaling\n"
                          "Example: myoid run-tool subject01_Setup_IK.xml");
  const auto o = std::make_shared<program::RunToolOptions>();
  const auto setups = std::make_shared<std::vector<std::string>>();
  command.add_option("setup", *setups, "Set-up files (.xml) and folders of set-up files")->required();
  command.add_option("--model", o->files.model, "Model (.osim), instead of the set-up's");
  command.add_option(
      "--motion", o->files.motion,
      "Coordinates or states (.mot, .sto), for inverse kinematics and scaling markers (.trc), instead of the set-up's");
  command.add_option("--external-loads", o->files.external_loads, "External loads (.xml), instead of the set-up's");
  command.add_option("--out", o->files.out,
                     "Folder of the results, instead of the set-up's; of several set-ups a folder in it for each");
  command.add_flag("--anywhere", o->anywhere,
                   "Write outside the folder of the set-up too, where the set-up says so (default: refused)");
  command
      .add_option(
          "--compat", o->compat,
          "opensim: paths of muscles as OpenSim 4.5.2 computes them; exact: as their geometry is (default opensim)")
      ->check(one_of({"opensim", "exact"}));
  add_common_options(command, context, {.seed = false, .range = false, .overwrite = false});
  command.callback([&context, o, setups] {
    o->call = context.call();
    if (setups->size() == 1 && !std::filesystem::is_directory(setups->front())) {
      o->setup = setups->front();
      run_one(*o, context);
      return;
    }
    if (!o->files.motion.empty() || !o->files.external_loads.empty())
      throw InvalidInput("--motion and --external-loads name the files of one trial; give one set-up with them");
    run_several({.call = o->call,
                 .setups = *setups,
                 .model = o->files.model.string(),
                 .out = o->files.out.string(),
                 .anywhere = o->anywhere,
                 .compat = o->compat},
                context);
  });
}

}  // namespace myoid::program
