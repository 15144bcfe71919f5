#include "myoid/model/wrap_cylinder.h"

#include <algorithm>
#include <cmath>

#include "myoid/core/units.h"

namespace myoid::model {
namespace {

/// The way around in one sense of rotation about z (+1 or -1), in the plane.
struct WayRound {
  double first_angle = 0.0;
  double turned = 0.0;  ///< 0 .. 2 pi
  double tangent1 = 0.0, tangent2 = 0.0;

  [[nodiscard]] double length(double radius) const { return tangent1 + radius * turned + tangent2; }
  [[nodiscard]] double middle_angle(int sense) const { return first_angle + 0.5 * sense * turned; }
};

WayRound way_round(double radius, const Vec3& p, const Vec3& q, int sense) {
  const double d1 = std::hypot(p.x(), p.y());
  const double d2 = std::hypot(q.x(), q.y());
  WayRound way;
  way.tangent1 = std::sqrt(d1 * d1 - radius * radius);
  way.tangent2 = std::sqrt(d2 * d2 - radius * radius);
  way.first_angle = std::atan2(p.y(), p.x()) + sense * std::acos(radius / d1);
  const double last_angle = std::atan2(q.y(), q.x()) - sense * std::acos(radius / d2);
  way.turned = std::fmod(sense * (last_angle - way.first_angle), 2.0 * kPi);
  if (way.turned < 0.0) way.turned += 2.0 * kPi;
  return way;
}

}  // namespace

std::optional<WrapContact> wrap_cylinder(const CylinderShape& cylinder,
                                         Quadrant quadrant,
                                         const Vec3& p_W,
                                         const Vec3& q_W) {
  const double radius = cylinder.radius_m;
  const double d1 = std::hypot(p_W.x(), p_W.y());
  const double d2 = std::hypot(q_W.x(), q_W.y());
  if (d1 <= radius || d2 <= radius) return std::nullopt;

  // Point of the chord that is nearest to the axis.
  const Eigen::Vector2d chord = (q_W - p_W).head<2>();
  const double along =
      chord.squaredNorm() > 0.0 ? -p_W.head<2>().dot(chord) / chord.squaredNorm() : 0.0;
  const Eigen::Vector2d nearest = p_W.head<2>() + along * chord;
  const bool cuts = along > 0.0 && along < 1.0 && nearest.norm() < radius;

  int sense = 1;
  if (quadrant == 0 || std::abs(quadrant) > 2) {
    if (!cuts) return std::nullopt;
    sense =
        way_round(radius, p_W, q_W, 1).turned <= way_round(radius, p_W, q_W, -1).turned ? 1 : -1;
  } else {
    const Eigen::Index axis = std::abs(quadrant) - 1;
    const double side = quadrant > 0 ? 1.0 : -1.0;
    const bool first_active = side * p_W[axis] > 0.0;
    const bool second_active = side * q_W[axis] > 0.0;
    if (first_active || second_active) {
      const bool wrong_side =
          first_active != second_active && along > 0.0 && along < 1.0 && side * nearest[axis] < 0.0;
      if (!cuts && !wrong_side) return std::nullopt;
    }
    // A turn of nearly a whole circle belongs to a way on which the straight line lies free of the
    // cylinder.
    const auto activity = [&](int s) {
      const WayRound way = way_round(radius, p_W, q_W, s);
      const double angle = way.middle_angle(s);
      return way.turned > 1.5 * kPi ? -2.0 : side * (axis == 0 ? std::cos(angle) : std::sin(angle));
    };
    sense = activity(1) >= activity(-1) ? 1 : -1;
    if (activity(sense) <= 0.0) return std::nullopt;
  }
  const WayRound way = way_round(radius, p_W, q_W, sense);
  const double planar = way.length(radius);
  const double rise = (q_W.z() - p_W.z()) / planar;
  const double last_angle = way.first_angle + sense * way.turned;
  WrapContact contact;
  contact.first_W = {radius * std::cos(way.first_angle), radius * std::sin(way.first_angle),
                     p_W.z() + rise * way.tangent1};
  contact.second_W = {radius * std::cos(last_angle), radius * std::sin(last_angle),
                      q_W.z() - rise * way.tangent2};
  const double half = 0.5 * cylinder.length_m;
  if (std::abs(contact.first_W.z()) > half && std::abs(contact.second_W.z()) > half)
    return std::nullopt;
  contact.arc_length_m = radius * way.turned * std::hypot(1.0, rise);
  return contact;
}

}  // namespace myoid::model
