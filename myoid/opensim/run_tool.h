#pragma once

#include <filesystem>

#include "myoid/opensim/tool_result.h"

namespace myoid::opensim {

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
/// `remarks` name every request of the set-up that is not done, and elements unknown to OpenSim.
/// Throws ReadError with the line for a set-up that cannot be read or run.
[[nodiscard]] ToolResult run_tool(const std::filesystem::path& setup, const ToolOptions& options = {});

}  // namespace myoid::opensim
