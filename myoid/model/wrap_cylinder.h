#pragma once

#include <optional>

#include "myoid/model/body_model.h"
#include "myoid/model/wrap_contact.h"

namespace myoid::model {

/// Returns the shortest path from p to q around a cylinder about the axis z of its frame: a straight piece to a tangent
/// point, a helix, a straight piece. The unrolled path is one line, so z changes evenly:
///
///   s = t1 + R theta + t2,  z(s) linear,  length = sqrt(s^2 + (z_q - z_p)^2)
///
/// dl/dq of a path over a cylinder is dl/dq of the straight pieces with the tangent points fixed to the object.
/// Quadrant 0: the path wraps only if the straight line cuts the cylinder, and on the shorter side. Other quadrants:
/// the arc lies on the named side (+-1 x, +-2 y), also if the straight line passes the axis on the other side. An end
/// on that side and a line that neither cuts the cylinder nor passes on the wrong side mean no contact. Empty: no
/// contact, an end inside, or both tangent points beyond the ends of the cylinder.
template <typename T>
[[nodiscard]] std::optional<ContactOf<T>> wrap_cylinder(const CylinderShape& cylinder,
                                                        Quadrant quadrant,
                                                        const Vector3<T>& p_W,
                                                        const Vector3<T>& q_W);

}  // namespace myoid::model
