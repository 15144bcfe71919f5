#pragma once

#include "myoid/osim/osim_frames.h"

namespace myoid::model {

/// Reads the joints of the JointSet or, in old documents, of the bodies, with their coordinates. A
/// body of an old document without a joint gets a FreeJoint to ground. A ScapulothoracicJoint
/// becomes an ellipsoid joint and a hinge with a massless body between.
void read_joints(OsimReading& reading, pugi::xml_node model);

}  // namespace myoid::model
