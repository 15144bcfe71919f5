#pragma once

#include <cmath>

#include "myoid/body/model/opensim_defects/wrap_opensim.h"

namespace myoid::body {

/// Returns the direction of v, or zero for the zero vector.
inline Vec3 unit_or_zero(const Vec3& v) {
  const double n = v.norm();
  return n > 0.0 ? Vec3(v / n) : Vec3::Zero();
}

/// Side of a wrap object on which paths may lie: axis 0..2 and sign, sign 0 for every side. OpenSim
/// counts a coordinate of zero to the positive side.
struct Side {
  Eigen::Index axis = 0;
  int sign = 0;

  explicit Side(Quadrant quadrant)
      : axis(quadrant == 0 ? 0 : std::abs(quadrant) - 1), sign(quadrant == 0 ? 0 : (quadrant > 0 ? 1 : -1)) {}
  [[nodiscard]] bool has(const Vec3& p) const { return (p[axis] >= 0.0 ? 1 : -1) == sign; }
};

/// The tangent points on one circle, counterclockwise (a) and clockwise (b).
struct Tangents {
  Vec3 a, b;
};

/// The tangent point, a or b, that counts at each end.
struct ChosenOfEnds {
  bool first_is_a = true, second_is_a = true;
};

/// Returns the tangent points whose directions, one of each end, are nearest to each other.
[[nodiscard]] ChosenOfEnds nearest_directions(const Tangents& first, const Tangents& second);

/// Each computes opensim_contact for one kind of surface.
[[nodiscard]] OpenSimContact opensim_cylinder_contact(const CylinderShape& cylinder,
                                                      const Side& side,
                                                      const Vec3& p_W,
                                                      const Vec3& q_W,
                                                      bool single,
                                                      const Compat& compat);
[[nodiscard]] OpenSimContact opensim_sphere_contact(
    const SphereShape& sphere, const Side& side, const Vec3& p_W, const Vec3& q_W, const Compat& compat);
[[nodiscard]] OpenSimContact opensim_torus_contact(
    const TorusShape& torus, const Side& side, const Vec3& p_W, const Vec3& q_W, bool single, const Compat& compat);

/// The contact is in the plane through p, q and a point of the surface, whose choice `method` names. A damped iteration
/// (to 1e-4) finds the tangent points, and the arc between them is a polyline of about 1 mm.
[[nodiscard]] OpenSimContact opensim_ellipsoid_contact(const EllipsoidShape& ellipsoid,
                                                       Quadrant quadrant,
                                                       WrapMethod method,
                                                       const Vec3& p_W,
                                                       const Vec3& q_W,
                                                       const Compat& compat);

}  // namespace myoid::body
