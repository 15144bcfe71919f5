#pragma once

#include <optional>

#include "myoid/core/geometry.h"
#include "myoid/model/body_model.h"

namespace myoid::model {

/// Where a path touches a wrap object, and how long it lies on it; in the wrap object's frame.
struct WrapContact {
  Vec3 first_W = Vec3::Zero();   ///< Tangent point on the side of the path's start [m].
  Vec3 second_W = Vec3::Zero();  ///< Tangent point on the side of its end [m].
  double arc_length_m = 0.0;     ///< Of the geodesic between them.
};

/// Shortest path from p to q around a cylinder whose axis is z of its frame: straight to a tangent
/// point, a helix, straight again. Unrolled it is one line, so that z falls evenly along it:
///
///   s = t1 + R theta + t2,  z(s) linear,  length = sqrt(s^2 + (z_q - z_p)^2)
///
/// and dl/dq of a path over it is that of the straight pieces with the tangent points held on the
/// object. With quadrant 0 the path wraps only if the straight line would cut the cylinder, and on
/// the shorter side. Otherwise the arc lies on the side that the quadrant names (+-1 x, +-2 y),
/// also where the straight line passes the axis on the other side; if either end is on that side
/// and the line neither cuts nor passes wrongly, there is no contact. Empty: no contact (also when
/// an end lies inside, or both tangent points lie beyond the ends of the cylinder).
[[nodiscard]] std::optional<WrapContact> wrap_cylinder(const CylinderShape& cylinder,
                                                       Quadrant quadrant,
                                                       const Vec3& p_W,
                                                       const Vec3& q_W);

}  // namespace myoid::model
