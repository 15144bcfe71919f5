#include "myoid/opensim/run_tool.h"

#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/opensim/setup_elements.h"
#include "myoid/opensim/tool_stages.h"

namespace myoid::opensim {

namespace {

constexpr std::pair<std::string_view, void (*)(const ToolRun&)> kRuns[] = {
    {"InverseKinematicsTool", run_inverse_kinematics},
    {"InverseDynamicsTool", run_inverse_dynamics},
    {"AnalyzeTool", run_analyses},
    {"ScaleTool", run_scale},
    {"ForwardTool", run_forward},
    {"IMUPlacer", run_imu_placer},
    {"IMUInverseKinematicsTool", run_imu_inverse_kinematics}};

}  // namespace

ToolResult run_tool(const std::filesystem::path& path, const ToolOptions& options) {
  const OpensimSetup setup(path, options.files);
  ToolResult result;
  result.inputs = setup.inputs();
  const std::vector<std::string> unknown = unknown_elements(setup.xml(), setup.tool());
  ToolFolders own;
  ToolFolders& folders = options.folders != nullptr ? *options.folders : own;
  const ToolRun run{setup, options, result, folders};
  run.add_notes(setup.notes());
  run.add_notes(unknown);
  run.add_notes(setup.xml().ignored());
  result.tool = setup.kind();
  try {
    for (const auto& [name, run_named] : kRuns)
      if (name == result.tool) run_named(run);
  } catch (const InvalidInput& error) {
    // A misspelt element is often the cause: the intended element is missing.
    if (unknown.empty()) throw;
    throw InvalidInput(fmt::format("{}; {}", error.what(), fmt::join(unknown, "; ")));
  }
  run.add_notes(setup.xml().repairs());
  run.add_notes(own.finish());
  return result;
}

}  // namespace myoid::opensim
