#pragma once

#include "myoid/model/opensim_defects/wrap_opensim.h"

namespace myoid::model {

/// Returns OpenSim's contact with an ellipsoid. The contact is in the plane through p, q and a
/// point of the surface, whose choice `method` names. A damped iteration (to 1e-4) finds the
/// tangent points, and the arc between them is a polyline of about 1 mm.
[[nodiscard]] OpenSimContact opensim_ellipsoid_contact(const EllipsoidShape& ellipsoid,
                                                       Quadrant quadrant,
                                                       WrapMethod method,
                                                       const Vec3& p_W,
                                                       const Vec3& q_W,
                                                       const Compat& compat);

}  // namespace myoid::model
