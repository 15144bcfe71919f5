#include "myoid/program/commands/run_tool.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/counted.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"
#include "myoid/program/commands/run_tools.h"

namespace myoid::program {
namespace {

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

void carry_out(Context& context, const RunToolsOptions& o, const CLI::App& /*command*/) {
  if (o.setups.size() != 1 || std::filesystem::is_directory(o.setups.front())) return run_several(o, context);
  RunToolOptions one = o;
  one.setup = o.setups.front();
  run_one(one, context);
}

}  // namespace

void add_run_tool(CLI::App& app, Context& context) {
  add_command<RunToolsOptions>(app, context, "run-tool",
                               "Run OpenSim set-up files: inverse kinematics, inverse dynamics, analyses, scaling\n"
                               "Example: myoid run-tool subject01_Setup_IK.xml",
                               {.seed = false, .range = false, .overwrite = false}, carry_out);
}

}  // namespace myoid::program
