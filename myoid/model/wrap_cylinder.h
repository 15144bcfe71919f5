#pragma once

#include <optional>

#include "myoid/model/body_model.h"
#include "myoid/model/wrap_contact.h"

namespace myoid::model {

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
template <typename T>
[[nodiscard]] std::optional<ContactOf<T>> wrap_cylinder(const CylinderShape& cylinder,
                                                        Quadrant quadrant,
                                                        const Vector3<T>& p_W,
                                                        const Vector3<T>& q_W);

extern template std::optional<WrapContact> wrap_cylinder(const CylinderShape&,
                                                         Quadrant,
                                                         const Vec3&,
                                                         const Vec3&);
extern template std::optional<ContactOf<Jet6>> wrap_cylinder(const CylinderShape&,
                                                             Quadrant,
                                                             const Vector3<Jet6>&,
                                                             const Vector3<Jet6>&);

}  // namespace myoid::model
