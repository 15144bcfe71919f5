#pragma once

#include <optional>

#include "myoid/model/body_model.h"
#include "myoid/model/wrap_contact.h"

namespace myoid::model {

/// Method `hybrid`, with OpenSim's numbers: the cosine between the line and the nearest axis at
/// which `axial` begins to count and counts alone, and the margin at each end of the chord in which
/// `axial` loses its weight (share of the chord).
inline constexpr double kBlendMin = 0.7073, kBlendMax = 0.9, kBoundary = 0.3;

/// Returns the point of the surface x^2/a^2 + y^2/b^2 + z^2/c^2 = 1 nearest to p. `plane` 0, 1 or 2
/// restricts both points to the plane in which that coordinate is zero. Inside the focal curve of a
/// plane of symmetry two points are equally near; the returned one lies in the plane.
[[nodiscard]] Vec3 closest_point_on_ellipsoid(const Vec3& radii_m, const Vec3& p, int plane = -1);

/// Returns the path from p to q over an ellipsoid by OpenSim's definition: the path lies in the plane through p, q and
/// a point c of the surface, and consists of two tangents of the ellipse in which the plane cuts the ellipsoid and the
/// arc between them on the side of c. Empty: the straight line misses the ellipsoid, an end lies inside, or the ends
/// lie in one direction from the center.
///
/// `midpoint`: c is nearest to the middle of the chord inside the ellipsoid. `axial`: the line crosses the plane of
/// symmetry across the axis most parallel to the line; c is the point of the surface within that plane that is nearest
/// to the crossing. `hybrid`: c blends `axial` with the mean direction from points along the chord to the surface, and
/// follows the mean direction alone if no axis is nearly parallel. A quadrant mirrors c to its side. The length of the
/// arc is exact (OpenSim uses a polyline of 1 mm chords, up to 1e-5 m shorter).
///
/// The path is not the shortest over the surface: -dl/dq differs from the moment of the unit tension along the straight
/// pieces by some tenths of a millimeter. `T` = Jet6 gives the derivatives by both ends.
template <typename T>
[[nodiscard]] std::optional<ContactOf<T>> wrap_ellipsoid(const EllipsoidShape& ellipsoid,
                                                         Quadrant quadrant,
                                                         WrapMethod method,
                                                         const Vector3<T>& p_W,
                                                         const Vector3<T>& q_W);

}  // namespace myoid::model
