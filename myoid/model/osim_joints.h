#pragma once

#include "myoid/model/osim_frames.h"

namespace myoid::model {

/// A function element of any kind; throws ReadError for an unknown one or bad numbers.
[[nodiscard]] Function read_function(const OsimReading& reading, pugi::xml_node node);
/// The function inside a holder (<function>, <x_location>, ...); empty if the holder is.
[[nodiscard]] std::optional<Function> function_in(const OsimReading& reading,
                                                  pugi::xml_node holder);

/// Reads the joints of the JointSet or, in old documents, of the bodies, with their coordinates. A
/// body of an old document without a joint gets a FreeJoint to ground. A ScapulothoracicJoint
/// becomes an ellipsoid joint and a hinge with a massless body between.
void read_joints(OsimReading& reading, pugi::xml_node model);

}  // namespace myoid::model
