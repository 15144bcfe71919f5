#pragma once

#include "myoid/osim/osim_frames.h"

namespace myoid::model {

/// Reads the enforced constraints; those of an unknown kind are listed in `unsupported`.
void read_constraints(OsimReading& reading, pugi::xml_node set);

/// Reads one constraint, `owner` being its path in the model; one that is not enforced is left out.
void read_constraint(OsimReading& reading, pugi::xml_node node, const std::string& owner);

}  // namespace myoid::model
