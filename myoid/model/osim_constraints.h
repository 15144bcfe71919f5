#pragma once

#include "myoid/model/osim_frames.h"

namespace myoid::model {

/// Reads the enforced constraints; those of an unknown kind are listed in `unsupported`.
void read_constraints(OsimReading& reading, pugi::xml_node set);

}  // namespace myoid::model
