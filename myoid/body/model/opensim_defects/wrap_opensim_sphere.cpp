#include <cmath>
#include <limits>

#include "myoid/body/model/opensim_defects/wrap_opensim_surfaces.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
OpenSimContact opensim_sphere_contact(
    const SphereShape& sphere, const Side& side, const Vec3& p, const Vec3& q, const Compat& compat) {
  OpenSimContact result;
  const double radius = sphere.radius_m;
  if (p.norm() < radius || q.norm() < radius) {
    result.action = WrapAction::inside;
    return result;
  }
  const Vec3 along = p - q;
  const double a = along.squaredNorm();
  const double b = 2.0 * q.dot(along);
  const double c = q.squaredNorm() - radius * radius;
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant < 0.0) return result;
  const double l1 = (-b + std::sqrt(discriminant)) / (2.0 * a);
  const double l2 = (-b - std::sqrt(discriminant)) / (2.0 * a);
  if (!(0.0 < l1 && l1 < 1.0) || !(0.0 < l2 && l2 < 1.0) || l1 < l2) return result;
  const Vec3 u = along.normalized();
  const Vec3 across = u.cross(q.normalized());
  if (across.norm() < 1e-5) {
    // The line goes through the center: OpenSim's points are NaN and never chosen.
    result.action = WrapAction::wrapped;
    result.arc_length_m = std::numeric_limits<double>::quiet_NaN();
    return result;
  }
  const Vec3 n = across.normalized();
  const auto tangents = [&](const Vec3& end) {
    const double distance = end.norm();
    const Vec3 inward = -end / distance;
    const Vec3 aside = n.cross(inward);
    const double tilt = std::asin(radius / distance);
    const double reach = distance * std::cos(tilt);
    return Tangents{end + reach * (std::cos(tilt) * inward + std::sin(tilt) * aside),
                    end + reach * (std::cos(tilt) * inward - std::sin(tilt) * aside)};
  };
  const Tangents t1 = tangents(p);
  const Tangents t2 = tangents(q);
  const Tangents u1{t1.a.normalized(), t1.b.normalized()}, u2{t2.a.normalized(), t2.b.normalized()};
  ChosenOfEnds chosen = nearest_directions(u1, u2);
  result.action = WrapAction::wrapped;
  bool far_side = false;
  const auto first = [&] { return chosen.first_is_a ? t1.a : t1.b; };
  const auto second = [&] { return chosen.second_is_a ? t2.a : t2.b; };
  if (side.sign != 0) {
    if (side.has(p) || side.has(q)) {
      const double foot_m = -p.dot(-u);  // from p towards q
      const Vec3 foot = p - foot_m * u;
      const double share = compat.negative_sphere_arc ? foot_m : foot_m / along.norm();
      if (foot.squaredNorm() < radius * radius && share > 0.0 && share < 1.0) {
        result.action = WrapAction::mandatory;
      } else if (side.has(p) == side.has(q) || side.has(foot)) {
        result.action = WrapAction::none;
        return result;
      }
    }
    if (!side.has(p) || !side.has(q)) {
      const Vec3 inward = -(p + q).normalized();
      chosen = {u1.a.dot(inward) > u1.b.dot(inward), u2.a.dot(inward) > u2.b.dot(inward)};
      const Vec3 sum = (first() - p) + (second() - q);
      if (side.sign * sum[side.axis] < 0.0) chosen = {!chosen.first_is_a, !chosen.second_is_a};
      far_side = (first() + second()).dot((first() - p) + (second() - q)) < 0.0;
    }
  }
  result.first_W = first();
  result.second_W = second();
  double angle = std::acos(result.first_W.normalized().dot(result.second_W.normalized()));
  if (far_side) angle = (compat.negative_sphere_arc ? -1.0 : 1.0) * (2.0 * kPi - angle);
  result.arc_length_m = radius * angle;
  result.has_points = true;
  return result;
}

}  // namespace myoid::body
