#pragma once

#include "myoid/model/body_model.h"

namespace myoid::model {

/// Turns round the joints whose parent hangs on their child (a chain that was drawn from its end to
/// ground), so that every body's joint leads to ground; the coordinates keep their meaning. Where
/// rotation and translation both move, a massless body stands between them. Throws ModelError for a
/// joint that cannot be turned: on an ellipsoid, at a rod, or with a coordinate that both turns and
/// shifts.
void orient_joints(BodyModel& model);

}  // namespace myoid::model
