#pragma once

#include <optional>

#include "myoid/body/model/body_model.h"
#include "myoid/body/model/wrap_contact.h"

namespace myoid::body {

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

/// Returns the path from p to q through the ring of a torus: around a cylinder of the tube's radius that touches the
/// ring's circle where the straight piece comes nearest to it, on the side of the ring's middle. (OpenSim's
/// construction, with the correct nearest point.) With a quadrant only points of the circle nearest to that side count.
/// The cylinder moves with p and q, so -dl/dq differs from the moment of the unit tension. `T` = Jet6 gives the
/// derivatives by both ends. Empty: no contact.
template <typename T>
[[nodiscard]] std::optional<ContactOf<T>> wrap_torus(const TorusShape& torus,
                                                     Quadrant quadrant,
                                                     const Vector3<T>& p_W,
                                                     const Vector3<T>& q_W);

/// Returns the frame of the cylinder that replaces the tube between p and q, in the torus's frame:
/// z along the tube, x to the middle of the ring. Empty: no point of the circle counts.
[[nodiscard]] std::optional<Pose> torus_tube(const TorusShape& torus,
                                             Quadrant quadrant,
                                             const Vec3& p_W,
                                             const Vec3& q_W);

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

}  // namespace myoid::body
