#pragma once

#include "myoid/model/osim_frames.h"

namespace myoid::model {

/// Reads muscles, actuators and passive forces of a force set; what is of an unknown kind, or only
/// partly understood, is listed in `unsupported`.
void read_forces(OsimReading& reading, pugi::xml_node set);

/// The same for forces that stand among the components of a model instead of in its force set.
void read_component_forces(OsimReading& reading, pugi::xml_node components);

}  // namespace myoid::model
