#pragma once

#include "myoid/osim/osim_frames.h"

namespace myoid::model {

/// Reads muscles, actuators and passive forces of a force set. Forces that are unknown or only
/// partly supported are listed in `unsupported`.
void read_forces(OsimReading& reading, pugi::xml_node set);

/// Reads one force of a force set.
void read_force(OsimReading& reading, pugi::xml_node node);

/// Reads a force among the components of a model, outside of the force set; ignores components of other kinds.
void read_component_force(OsimReading& reading, pugi::xml_node node);

}  // namespace myoid::model
