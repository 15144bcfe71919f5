#pragma once

#include <vector>

#include "myoid/osim/osim_frames.h"

namespace myoid::model {

/// Returns the pairs of a HuntCrossleyForce or a SmoothSphereHalfSpaceForce that can touch: spheres with half-spaces
/// and with spheres of other bodies. Surfaces of other kinds (meshes) are listed in `unsupported`.
[[nodiscard]] std::vector<Contact> read_contacts(OsimReading& reading, pugi::xml_node force);

}  // namespace myoid::model
