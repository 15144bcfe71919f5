#pragma once

#include "myoid/opensim_tools/opensim_setup.h"
#include "myoid/opensim_tools/tool_result.h"

namespace myoid {

/// Runs IMUPlacer: writes the model with the frames of inertial sensors, which follow from their
/// first orientations on the model's default posture. A sensor "<body>_imu" belongs to that body.
void run_imu_placer(const OpensimSetup& setup, const ToolOptions& options, ToolResult& result);
/// Runs IMUInverseKinematicsTool: finds the motion that fits the sensors' orientations best, and the remaining angles.
void run_imu_inverse_kinematics(const OpensimSetup& setup, const ToolOptions& options, ToolResult& result);

}  // namespace myoid
