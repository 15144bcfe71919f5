#pragma once

#include "myoid/opensim_tools/opensim_setup.h"
#include "myoid/opensim_tools/tool_result.h"

namespace myoid {

/// IMUPlacer: writes the model with the frames of inertial sensors, as their first orientations
/// show them on the model's default posture. A sensor "<body>_imu" belongs to that body.
void run_imu_placer(const OpensimSetup& setup, const ToolOptions& options, ToolResult& result);
/// IMUInverseKinematicsTool: the motion that fits the sensors' orientations best, and the angles
/// that are left.
void run_imu_inverse_kinematics(const OpensimSetup& setup,
                                const ToolOptions& options,
                                ToolResult& result);

}  // namespace myoid
