#pragma once

#include <optional>

#include "myoid/model/body_model.h"
#include "myoid/model/wrap_contact.h"

namespace myoid::model {

/// Returns the path from p to q over a sphere, in the plane through p, q and the center: two tangents and the arc of
/// the great circle between them. There is contact only if the straight line cuts the sphere. The path takes the short
/// way, unless a quadrant is named, not both ends lie on its side and the tangents of the far side point to it, as in
/// OpenSim; the far arc has its full length. Either way is a geodesic: -dl/dq is the moment of the unit tension. Empty:
/// no contact (also if an end lies inside or the line goes through the center).
template <typename T>
[[nodiscard]] std::optional<ContactOf<T>> wrap_sphere(const SphereShape& sphere,
                                                      Quadrant quadrant,
                                                      const Vector3<T>& p_W,
                                                      const Vector3<T>& q_W);

}  // namespace myoid::model
