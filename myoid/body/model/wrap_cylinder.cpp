#include <cmath>

#include "myoid/body/model/wrap_surfaces.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

/// The way around the cylinder in one sense of rotation about z (+1 or -1), in the plane.
template <typename T>
struct WayRound {
  T first_angle = T(0.0);
  T turned = T(0.0);  ///< 0 .. 2 pi
  T tangent1 = T(0.0), tangent2 = T(0.0);

  [[nodiscard]] T length(double radius) const { return tangent1 + T(radius) * turned + tangent2; }
  [[nodiscard]] T middle_angle(int sense) const { return first_angle + T(0.5 * sense) * turned; }
};

template <typename T>
WayRound<T> way_round(double radius, const Vector3<T>& p, const Vector3<T>& q, int sense) {
  using std::acos;
  using std::atan2;
  using std::sqrt;
  const T d1 = sqrt(p.x() * p.x() + p.y() * p.y());
  const T d2 = sqrt(q.x() * q.x() + q.y() * q.y());
  const T R(radius);
  const T sign(sense);
  WayRound<T> way;
  way.tangent1 = sqrt(d1 * d1 - R * R);
  way.tangent2 = sqrt(d2 * d2 - R * R);
  way.first_angle = atan2(p.y(), p.x()) + sign * acos(R / d1);
  const T last_angle = atan2(q.y(), q.x()) - sign * acos(R / d2);
  way.turned = within_one_turn(T(sign * (last_angle - way.first_angle)));
  return way;
}

/// Returns the sense in which the path goes round; empty if it does not.
std::optional<int> sense_of(double radius, Quadrant quadrant, const Vec3& p, const Vec3& q) {
  const double d1 = std::hypot(p.x(), p.y());
  const double d2 = std::hypot(q.x(), q.y());
  if (d1 <= radius || d2 <= radius) return std::nullopt;

  // Point of the chord that is nearest to the axis.
  const Eigen::Vector2d chord = (q - p).head<2>();
  const double along = chord.squaredNorm() > 0.0 ? -p.head<2>().dot(chord) / chord.squaredNorm() : 0.0;
  const Eigen::Vector2d nearest = p.head<2>() + along * chord;
  const bool cuts = along > 0.0 && along < 1.0 && nearest.norm() < radius;

  if (quadrant == 0 || std::abs(quadrant) > 2) {
    if (!cuts) return std::nullopt;
    return way_round(radius, p, q, 1).turned <= way_round(radius, p, q, -1).turned ? 1 : -1;
  }
  const Eigen::Index axis = std::abs(quadrant) - 1;
  const double side = quadrant > 0 ? 1.0 : -1.0;
  const bool first_active = side * p[axis] > 0.0;
  const bool second_active = side * q[axis] > 0.0;
  if (first_active || second_active) {
    const bool wrong_side = first_active != second_active && along > 0.0 && along < 1.0 && side * nearest[axis] < 0.0;
    if (!cuts && !wrong_side) return std::nullopt;
  }
  // A turn of nearly a whole circle belongs to a path whose straight line does not touch the cylinder.
  const auto activity = [&](int s) {
    const WayRound<double> way = way_round(radius, p, q, s);
    const double angle = way.middle_angle(s);
    return way.turned > 1.5 * kPi ? -2.0 : side * (axis == 0 ? std::cos(angle) : std::sin(angle));
  };
  const int sense = activity(1) >= activity(-1) ? 1 : -1;
  if (activity(sense) <= 0.0) return std::nullopt;
  return sense;
}

}  // namespace

template <typename T>
std::optional<ContactOf<T>> wrap_cylinder(const CylinderShape& cylinder,
                                          Quadrant quadrant,
                                          const Vector3<T>& p_W,
                                          const Vector3<T>& q_W) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const double radius = cylinder.radius_m;
  const std::optional<int> sense = sense_of(radius, quadrant, value_of(p_W), value_of(q_W));
  if (!sense) return std::nullopt;
  const WayRound<T> way = way_round(radius, p_W, q_W, *sense);
  const T rise = (q_W.z() - p_W.z()) / way.length(radius);
  const T last_angle = way.first_angle + T(*sense) * way.turned;
  ContactOf<T> contact;
  contact.first_W = {T(radius) * cos(way.first_angle), T(radius) * sin(way.first_angle), p_W.z() + rise * way.tangent1};
  contact.second_W = {T(radius) * cos(last_angle), T(radius) * sin(last_angle), q_W.z() - rise * way.tangent2};
  const double half = 0.5 * cylinder.length_m;
  if (std::abs(value_of(contact.first_W.z())) > half && std::abs(value_of(contact.second_W.z())) > half)
    return std::nullopt;
  contact.arc_length_m = T(radius) * way.turned * sqrt(T(1.0) + rise * rise);
  return contact;
}

template std::optional<WrapContact> wrap_cylinder(const CylinderShape&, Quadrant, const Vec3&, const Vec3&);
template std::optional<ContactOf<Jet6>> wrap_cylinder(const CylinderShape&,
                                                      Quadrant,
                                                      const Vector3<Jet6>&,
                                                      const Vector3<Jet6>&);

}  // namespace myoid::body
