#pragma once

#include "myoid/arm/arm4.h"
#include "myoid/osim/osim_reader.h"

namespace myoid::test {

/// The model of the built-in arm, from its file.
inline model::BodyModel built_in_arm() { return model::parse_osim(model::arm4_osim(), "arm4.osim"); }

}  // namespace myoid::test
