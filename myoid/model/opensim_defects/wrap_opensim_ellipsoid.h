#pragma once

#include "myoid/model/opensim_defects/wrap_opensim.h"

namespace myoid::model {

/// OpenSim's contact with an ellipsoid: in the plane through p, q and a point of the surface, whose
/// choice `method` names, tangent points by a damped iteration (to 1e-4) and the arc between them
/// as a polyline of about 1 mm.
[[nodiscard]] OpenSimContact opensim_ellipsoid_contact(const EllipsoidShape& ellipsoid,
                                                       Quadrant quadrant,
                                                       WrapMethod method,
                                                       const Vec3& p_W,
                                                       const Vec3& q_W,
                                                       const Compat& compat);

}  // namespace myoid::model
