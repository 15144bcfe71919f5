#include "myoid/opensim_tools/run_tool.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/opensim_tools/setup_elements.h"
#include "myoid/opensim_tools/tool_forward.h"
#include "myoid/opensim_tools/tool_orientations.h"
#include "myoid/opensim_tools/tool_stages.h"

namespace myoid {

namespace {

void run_named_tool(const OpensimSetup& setup, const ToolOptions& options, ToolResult& result) {
  if (result.tool == "InverseKinematicsTool") {
    run_inverse_kinematics(setup, options, result);
  } else if (result.tool == "InverseDynamicsTool") {
    run_inverse_dynamics(setup, options, result);
  } else if (result.tool == "ScaleTool") {
    run_scale(setup, options, result);
  } else if (result.tool == "ForwardTool") {
    run_forward(setup, options, result);
  } else if (result.tool == "IMUPlacer") {
    run_imu_placer(setup, options, result);
  } else if (result.tool == "IMUInverseKinematicsTool") {
    run_imu_inverse_kinematics(setup, options, result);
  } else {
    run_analyses(setup, options, result);
  }
}

}  // namespace

ToolResult run_tool(const std::filesystem::path& path, const ToolOptions& options) {
  const OpensimSetup setup(path, options.files);
  ToolResult result;
  result.inputs = setup.inputs();
  result.notes = setup.notes();
  const std::vector<std::string> unknown = unknown_elements(setup.xml(), setup.tool());
  result.notes.insert(result.notes.end(), unknown.begin(), unknown.end());
  result.tool = setup.kind();
  try {
    run_named_tool(setup, options, result);
  } catch (const InvalidInput& error) {
    // A misspelt element is often the cause: the intended element is missing.
    if (unknown.empty()) throw;
    throw InvalidInput(fmt::format("{}; {}", error.what(), fmt::join(unknown, "; ")));
  }
  const std::vector<std::string>& defaulted = setup.xml().defaulted();
  result.notes.insert(result.notes.end(), defaulted.begin(), defaulted.end());
  return result;
}

}  // namespace myoid
