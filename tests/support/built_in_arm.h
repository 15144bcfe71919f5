#pragma once

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::test {

/// The model of the built-in arm, from its file.
inline body::BodyModel built_in_arm() { return body::parse_osim(body::arm4_osim(), "arm4.osim"); }

}  // namespace myoid::test
