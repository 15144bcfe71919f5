#pragma once

#include <optional>

#include "myoid/model/body_model.h"
#include "myoid/model/wrap_contact.h"

namespace myoid::model {

/// Point of the surface x^2/a^2 + y^2/b^2 + z^2/c^2 = 1 nearest to p. With `plane` 0, 1 or 2 both
/// are taken in the plane where that coordinate is zero. On a plane of symmetry inside the focal
/// curve, where two points are equally near, one in that plane is returned.
[[nodiscard]] Vec3 closest_point_on_ellipsoid(const Vec3& radii_m, const Vec3& p, int plane = -1);

/// Path from p to q over an ellipsoid as OpenSim defines it: it lies in one plane, through p, q and
/// a point c of the surface, and consists of two tangents of the ellipse in which the plane cuts
/// the ellipsoid and the arc between them on the side of c. Empty: the straight line does not pass
/// through the ellipsoid, an end lies inside, or the ends lie in one direction from the center.
///
/// c is, `midpoint`: nearest to the middle of the chord inside the ellipsoid; `axial`: nearest,
/// within the plane of symmetry across the axis that is most parallel to the line, to where the
/// line crosses this plane; `hybrid`: a blend of `axial` with the mean direction from points along
/// the chord to the surface, the latter alone where no axis is nearly parallel. A quadrant mirrors
/// c to its side. The arc's length is exact (OpenSim's is a polyline of 1 mm chords, up to 1e-5 m
/// shorter).
///
/// Such a path is not the shortest over the surface: -dl/dq differs from the moment of the unit
/// tension along its straight pieces by some tenths of a millimeter. With `T` = Jet6 the
/// derivatives by both ends come along.
template <typename T>
[[nodiscard]] std::optional<ContactOf<T>> wrap_ellipsoid(const EllipsoidShape& ellipsoid,
                                                         Quadrant quadrant,
                                                         WrapMethod method,
                                                         const Vector3<T>& p_W,
                                                         const Vector3<T>& q_W);

extern template std::optional<WrapContact> wrap_ellipsoid(
    const EllipsoidShape&, Quadrant, WrapMethod, const Vec3&, const Vec3&);
extern template std::optional<ContactOf<Jet6>> wrap_ellipsoid(
    const EllipsoidShape&, Quadrant, WrapMethod, const Vector3<Jet6>&, const Vector3<Jet6>&);

}  // namespace myoid::model
