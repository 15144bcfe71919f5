#pragma once

#include "myoid/body/model/body_model.h"

namespace myoid::body {

/// Reverses joints whose parent hangs on their child (a chain that the file describes from its end to ground), so that
/// the joint of every body leads to ground; the coordinates keep their meaning. If both rotation and translation move,
/// a massless body between them is added. Throws ModelError for a joint that cannot be reversed: an ellipsoid joint, a
/// rod, or a joint with a coordinate that both turns and shifts.
void orient_joints(BodyModel& model);

}  // namespace myoid::body
