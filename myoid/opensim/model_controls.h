#pragma once

#include <map>
#include <string>
#include <vector>

#include "myoid/body/simulation/excitation.h"
#include "myoid/opensim/opensim_setup.h"

namespace myoid::opensim {

/// Controls over time by the names of muscles and actuators.
using ModelControls = std::map<std::string, body::Signal>;

/// Reads the controls in the set-up's <ControllerSet>: of ControlSetControllers with a <controls_file>, a table (.sto)
/// or a <ControlSet> (.xml) of ControlLinear and ControlConstant. "<name>.excitation" and ".../<name>" control the
/// muscle of that name. An enabled controller of another class is named in `remarks` or, without `remarks`, throws
/// ReadError. A file without controls throws ReadError.
[[nodiscard]] ModelControls read_model_controls(const OpensimSetup& setup, std::vector<Remark>* remarks = nullptr);

}  // namespace myoid::opensim
