#pragma once

#include <filesystem>

#include "myoid/opensim_tools/tool_result.h"

namespace myoid {

/// Runs a set-up file of OpenSim's InverseKinematicsTool, InverseDynamicsTool or AnalyzeTool (with
/// StaticOptimization, MuscleAnalysis or Kinematics) and writes the files that the tool would, with
/// its names, headers and columns. Throws ReadError with the line for what cannot be read or run.
[[nodiscard]] ToolResult run_tool(const std::filesystem::path& setup,
                                  const ToolOptions& options = {});

}  // namespace myoid
