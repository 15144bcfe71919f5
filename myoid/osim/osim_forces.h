#pragma once

#include "myoid/osim/osim_frames.h"

namespace myoid::model {

/// Reads muscles, actuators and passive forces of a force set; what is of an unknown kind, or only
/// partly understood, is listed in `unsupported`.
void read_forces(OsimReading& reading, pugi::xml_node set);

/// Reads one force of a force set.
void read_force(OsimReading& reading, pugi::xml_node node);

/// Reads a force that stands among the components of a model instead of in its force set; leaves
/// components of other kinds alone.
void read_component_force(OsimReading& reading, pugi::xml_node node);

}  // namespace myoid::model
