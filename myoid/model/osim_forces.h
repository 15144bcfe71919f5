#pragma once

#include "myoid/model/osim_frames.h"

namespace myoid::model {

/// Reads muscles, actuators and passive forces of a force set; what is of an unknown kind, or only
/// partly understood, is listed in `unsupported`.
void read_forces(OsimReading& reading, pugi::xml_node set);

/// Reads the enforced constraints; those of an unknown kind are listed in `unsupported`.
void read_constraints(OsimReading& reading, pugi::xml_node set);

}  // namespace myoid::model
