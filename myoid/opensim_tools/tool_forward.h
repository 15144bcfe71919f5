#pragma once

#include "myoid/opensim_tools/opensim_setup.h"
#include "myoid/opensim_tools/tool_result.h"

namespace myoid {

/// Runs ForwardTool: integrates the model from a row of its <states_file> (or its default state) under the controls of
/// a ControlSetController, and writes <name>_states.sto, _states_degrees.mot and _controls.sto. Throws ReadError for
/// loads on bodies, other controllers and controls of actuators that act on bodies.
void run_forward(const OpensimSetup& setup, const ToolOptions& options, ToolResult& result);

}  // namespace myoid
