#include <cmath>

#include "myoid/body/model/wrap_surfaces.h"

namespace myoid::body {
namespace {

template <typename T>
ContactOf<T> way_over(double radius, const Vector3<T>& p, const Vector3<T>& q, bool far_side) {
  using std::acos;
  using std::atan2;
  using std::cos;
  using std::sin;
  const T R(radius);
  const Vector3<T> across = p.cross(q);
  const T sine = across.norm();
  const Vector3<T> n = across / sine;
  const T between = atan2(sine, p.dot(q));
  const T alpha = acos(R / p.norm());
  const T beta = acos(R / q.norm());
  const T sense(far_side ? -1.0 : 1.0);
  const auto turned = [&](const Vector3<T>& end, const T& angle) {
    const Vector3<T> unit = end.normalized();
    return Vector3<T>(R * (cos(angle) * unit + sin(angle) * n.cross(unit)));
  };
  ContactOf<T> contact;
  contact.first_W = turned(p, T(sense * alpha));
  contact.second_W = turned(q, T(-sense * beta));
  contact.arc_length_m = R * ((far_side ? T(2.0 * kPi) - between : between) - alpha - beta);
  return contact;
}

}  // namespace

template <typename T>
std::optional<ContactOf<T>> wrap_sphere(const SphereShape& sphere,
                                        Quadrant quadrant,
                                        const Vector3<T>& p_W,
                                        const Vector3<T>& q_W) {
  const double radius = sphere.radius_m;
  const Vec3 p = value_of(p_W);
  const Vec3 q = value_of(q_W);
  if (p.norm() <= radius || q.norm() <= radius) return std::nullopt;
  const Vec3 along = q - p;
  const double share = -p.dot(along) / along.squaredNorm();
  const Vec3 nearest = p + share * along;
  if (!(share > 0.0 && share < 1.0 && nearest.norm() < radius)) return std::nullopt;
  if (along.normalized().cross(q.normalized()).norm() < 1e-5) return std::nullopt;
  bool far_side = false;
  if (quadrant != 0) {
    const Eigen::Index axis = std::abs(quadrant) - 1;
    const double side = quadrant > 0 ? 1.0 : -1.0;
    if (side * p[axis] < 0.0 || side * q[axis] < 0.0) {
      const auto tension = [&](const WrapContact& c) -> Vec3 { return (c.first_W - p) + (c.second_W - q); };
      const WrapContact near_way = way_over<double>(radius, p, q, false);
      const WrapContact far_way = way_over<double>(radius, p, q, true);
      const Vec3 inward = -(p + q);
      far_side = (far_way.first_W + far_way.second_W).dot(inward) > (near_way.first_W + near_way.second_W).dot(inward);
      if (side * tension(far_side ? far_way : near_way)[axis] < 0.0) far_side = !far_side;
    }
  }
  return way_over<T>(radius, p_W, q_W, far_side);
}

template std::optional<WrapContact> wrap_sphere(const SphereShape&, Quadrant, const Vec3&, const Vec3&);
template std::optional<ContactOf<Jet6>> wrap_sphere(const SphereShape&,
                                                    Quadrant,
                                                    const Vector3<Jet6>&,
                                                    const Vector3<Jet6>&);

}  // namespace myoid::body
