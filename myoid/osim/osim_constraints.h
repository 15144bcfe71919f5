#pragma once

#include "myoid/osim/osim_frames.h"

namespace myoid::model {

/// Reads the enforced constraints; constraints of an unknown kind are listed in `unsupported`.
void read_constraints(OsimReading& reading, pugi::xml_node set);

/// Reads a constraint if it is enforced; `owner` is its path in the model.
void read_constraint(OsimReading& reading, pugi::xml_node node, const std::string& owner);

}  // namespace myoid::model
