#pragma once

#include <filesystem>

#include "myoid/opensim_tools/tool_result.h"

namespace myoid {

/// Runs a set-up file of one of OpenSim's tools and writes the files that the tool would, with its
/// names, headers and columns:
///
///   InverseKinematicsTool, IKTool
///   InverseDynamicsTool
///   AnalyzeTool: StaticOptimization, MuscleAnalysis, Kinematics, BodyKinematics, PointKinematics
///     (each with accelerations), ForceReporter, Actuation, InverseDynamics, JointReaction,
///     OutputReporter
///   ScaleTool
///   ForwardTool
///   IMUPlacer, IMUInverseKinematicsTool
///
/// `notes` names everything that the set-up asks for and that is not done, elements that OpenSim
/// does not know among them. Throws ReadError with the line for what cannot be read or run.
[[nodiscard]] ToolResult run_tool(const std::filesystem::path& setup,
                                  const ToolOptions& options = {});

}  // namespace myoid
