#include <cmath>
#include <limits>

#include "myoid/body/model/opensim_defects/wrap_opensim_surfaces.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

/// Nearest points of two infinite lines, s along the first as a share of p1 p2.
struct NearestOfLines {
  bool parallel = true;
  double share = std::numeric_limits<double>::quiet_NaN();
  Vec3 on_first = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 on_second = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
};

NearestOfLines nearest_of_lines(const Vec3& p1, const Vec3& p2, const Vec3& p3, const Vec3& p4) {
  constexpr double kParallel = 2e-13;
  NearestOfLines n;
  const double length = (p2 - p1).norm();
  const Vec3 u = (p2 - p1) / length;
  const Vec3 v = (p4 - p3).normalized();
  const Vec3 cross = u.cross(v);
  const double denominator = cross.squaredNorm();
  if (!(denominator > kParallel)) return n;
  const Vec3 d = p3 - p1;
  const double s = d.cross(v).dot(cross) / denominator;
  const double t = d.cross(u).dot(cross) / denominator;
  n.parallel = false;
  n.on_first = p1 + s * u;
  n.on_second = p3 + t * v;
  n.share = s / length;
  return n;
}

/// Returns the feet of the tangents from p to the cylinder in the plane across z through p.
Tangents tangents_from(const Vec3& p, double radius) {
  const Vec3 radial(p.x(), p.y(), 0.0);
  const double distance = radial.norm();
  const Vec3 v = distance > 0.0 ? Vec3(radial / distance) : Vec3::Zero();
  const double along = radius * (radius / distance);
  const double aside = std::sqrt(radius * radius - along * along);
  const Vec3 foot(along * v.x(), along * v.y(), p.z());
  const Vec3 u = Vec3::UnitZ().cross(v);
  return {foot + aside * u, foot - aside * u};
}

/// Finds the point where the generator through r meets the plane; false, with `point` unchanged, if
/// they do not meet within 10 m.
bool meets_plane(const Vec3& r, const Vec3& normal, double offset, Vec3& point) {
  constexpr double kHalf_m = 10.0;
  constexpr double kEpsilon = 1e-5;
  const Vec3 begin = r - kHalf_m * Vec3::UnitZ();
  const Vec3 along(0.0, 0.0, 2.0 * kHalf_m);
  const double slope = along.dot(normal);
  if (std::abs(slope) < kEpsilon) return false;
  const double t = (-offset - normal.dot(begin)) / slope;
  if (t < -kEpsilon || t > 1.0 + kEpsilon) return false;
  point = begin + t * along;
  return true;
}

/// Computes the length of the helix from first to second and adjusts both if asked; OpenSim's rule decides `long_way`.
class Helix {
 public:
  Helix(double radius, bool long_way, const Compat& compat) : radius_(radius), long_way_(long_way), compat_(compat) {}

  double settle(const Vec3& p, const Vec3& q, bool single, Vec3& first, Vec3& second) {
    constexpr int kMostSlides = 100;
    constexpr double kChord_m = 0.002;
    measure(first, second);
    for (int slides = 0; !single && slides < kMostSlides; ++slides) {
      const int pieces = static_cast<int>(length_ / kChord_m);
      if (!(length_ < 1e6) || pieces < 2) break;
      const double t = 1.0 / pieces;
      // The second point is corrected with the corrected first one.
      const bool first_moved = slide(p, point(first, t), first);
      const bool second_moved = slide(q, point(first, 1.0 - t), second);
      if (!first_moved && !second_moved) break;
      measure(first, second);
    }
    return length_;
  }

 private:
  void measure(const Vec3& first, const Vec3& second) {
    rise_ = second.z() - first.z();
    theta_ =
        std::atan2(first.x() * second.y() - first.y() * second.x(), first.x() * second.x() + first.y() * second.y());
    if (long_way_) {
      theta_ = compat_.long_turn_of_negative_angle ? 2.0 * kPi - theta_ : 2.0 * kPi - std::abs(theta_);
    }
    length_ = std::sqrt(radius_ * theta_ * (radius_ * theta_) + rise_ * rise_);
  }
  [[nodiscard]] Vec3 point(const Vec3& first, double t) const {
    const double angle = (long_way_ ? -1.0 : 1.0) * t * theta_;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * first.x() - s * first.y(), s * first.x() + c * first.y(), first.z() + t * rise_};
  }
  /// Slides r along z so that the angles of end - r and r - on_helix to the axis become nearly equal.
  static bool slide(const Vec3& end, const Vec3& on_helix, Vec3& r) {
    constexpr double kTangency_rad = 0.1 * kDegree;
    const double straight = unit_or_zero(r - end).z();
    const double curved = unit_or_zero(on_helix - r).z();
    // Angles differ by more than their cosines.
    if (!(std::abs(straight - curved) > kTangency_rad) &&
        !(std::abs(std::acos(straight) - std::acos(curved)) > kTangency_rad))
      return false;
    const NearestOfLines n =
        nearest_of_lines(end, on_helix, Vec3(r.x(), r.y(), end.z()), Vec3(r.x(), r.y(), on_helix.z()));
    if (!n.parallel) r += 1.5 * (n.on_second - r);
    return true;
  }

  double radius_;
  bool long_way_;
  const Compat& compat_;
  double theta_ = 0.0, rise_ = 0.0, length_ = 0.0;
};

struct ChosenTangents {
  Vec3 first, second;
  bool far_side = false;
  bool long_way = false;
};

/// Returns the pair of tangent points on the side that counts.
ChosenTangents choose_on_side(const Side& side, const Tangents& t1, const Tangents& t2, const Vec3& p, const Vec3& q) {
  const Vec3 foot1(0.0, 0.0, p.z());
  const Vec3 foot2(0.0, 0.0, q.z());
  const auto angle = [&](const Vec3& r1, const Vec3& r2) {
    const Vec3 u = r1 - foot1;
    const Vec3 v = r2 - foot2;
    return std::acos(u.dot(v) / (u.norm() * v.norm()));
  };
  const double alpha = angle(t1.a, t2.b);
  const double beta = angle(t1.b, t2.a);
  const bool a1 = side.has(t1.a);
  const bool b1 = side.has(t1.b);
  bool take_ab = false;  // first a, second b; else first b, second a
  bool none = false;
  if (a1 != b1) {
    take_ab = a1;
  } else if (a1) {
    take_ab = !side.has(t2.a);
  } else if (side.has(t2.a)) {
    take_ab = false;
  } else if (side.has(t2.b)) {
    take_ab = true;
  } else {
    none = true;
    take_ab = alpha > beta;
  }
  ChosenTangents c;
  c.first = take_ab ? t1.a : t1.b;
  c.second = take_ab ? t2.b : t2.a;
  c.far_side = none || (take_ab ? alpha > beta : !(alpha > beta));
  const Vec3 from_ends = (c.first - p) + (c.second - q);
  const Vec3 from_axis = (c.first - foot1) + (c.second - foot2);
  c.long_way = from_axis.dot(from_ends) < 0.0;
  return c;
}

ChosenTangents choose_nearest(const Tangents& t1, const Tangents& t2, const Vec3& p, const Vec3& q) {
  const Vec3 foot1(0.0, 0.0, p.z());
  const Vec3 foot2(0.0, 0.0, q.z());
  const auto [first_is_a, second_is_a] = nearest_directions({unit_or_zero(t1.a - foot1), unit_or_zero(t1.b - foot1)},
                                                            {unit_or_zero(t2.a - foot2), unit_or_zero(t2.b - foot2)});
  return {first_is_a ? t1.a : t1.b, second_is_a ? t2.a : t2.b};
}

/// Moves the tangent points, which were found across the axis, along their generators into the
/// plane through p, q and the apex of the path over the cylinder.
void slide_to_plane(const Vec3& p, const Vec3& q, double radius, ChosenTangents& c) {
  const Vec3 foot1(0.0, 0.0, p.z());
  const Vec3 foot2(0.0, 0.0, q.z());
  const double d1 = p.head<2>().norm();
  const double d2 = q.head<2>().norm();
  const Vec3 middle = p + d1 / (d1 + d2) * (q - p);
  const Vec3 on_axis(0.0, 0.0, middle.z());
  const Vec3 across = unit_or_zero(p - on_axis).cross(unit_or_zero(q - on_axis)).normalized();
  const Vec3 up = unit_or_zero(Vec3::UnitZ().cross(across));
  const Vec3 apex1 = on_axis + radius * up;
  const Vec3 apex2 = on_axis - radius * up;
  const bool first_nearer = (middle - apex1).squaredNorm() < (middle - apex2).squaredNorm();
  const Vec3 apex = first_nearer != c.far_side ? apex1 : apex2;
  const Vec3 normal = unit_or_zero(p - apex).cross(unit_or_zero(q - apex)).normalized();
  const double offset = -p.dot(normal);
  // A point moves only if its foot on the axis is towards the other end.
  const auto foot_of = [&](const Vec3& r) { return q.z() != 0.0 ? Vec3(0.0, 0.0, r.z()) : foot1; };
  const double between = (foot1 - foot2).squaredNorm();
  Vec3 moved;
  const bool first_meets = meets_plane(c.first, normal, offset, moved);
  Vec3 second_moved;
  const bool second_meets = meets_plane(c.second, normal, offset, second_moved);
  if (first_meets && (foot_of(moved) - foot2).squaredNorm() < between) c.first = moved;
  if (second_meets && (foot_of(second_moved) - foot1).squaredNorm() < between) c.second = second_moved;
}

}  // namespace

ChosenOfEnds nearest_directions(const Tangents& first, const Tangents& second) {
  const double aa = first.a.dot(second.a), ab = first.a.dot(second.b);
  const double ba = first.b.dot(second.a), bb = first.b.dot(second.b);
  if (aa > ab && aa > ba && aa > bb) return {true, true};
  if (ab > ba && ab > bb) return {true, false};
  return {false, ba > bb};
}

OpenSimContact opensim_cylinder_contact(
    const CylinderShape& cylinder, const Side& side, const Vec3& p, const Vec3& q, bool single, const Compat& compat) {
  OpenSimContact result;
  const double radius = cylinder.radius_m;
  const double r2 = radius * radius;
  if (p.head<2>().squaredNorm() < r2 || q.head<2>().squaredNorm() < r2) {
    result.action = WrapAction::inside;
    return result;
  }
  const double half = 0.5 * cylinder.length_m;
  const NearestOfLines near = nearest_of_lines(p, q, Vec3(0.0, 0.0, -half), Vec3(0.0, 0.0, half));
  const bool hit =
      !near.parallel && (near.on_first - near.on_second).squaredNorm() < r2 && near.share > 0.0 && near.share < 1.0;
  WrapAction action = WrapAction::wrapped;
  if (side.sign == 0) {
    if (!hit) return result;
    action = WrapAction::mandatory;
  } else if (side.has(p) || side.has(q)) {
    if (hit) {
      action = WrapAction::mandatory;
    } else if (side.has(p) == side.has(q) || side.has(near.on_first)) {
      return result;
    }
  }
  const Tangents t1 = tangents_from(p, radius);
  const Tangents t2 = tangents_from(q, radius);
  ChosenTangents chosen = side.sign != 0 ? choose_on_side(side, t1, t2, p, q) : choose_nearest(t1, t2, p, q);
  slide_to_plane(p, q, radius, chosen);
  if (std::abs(chosen.first.z()) > half && std::abs(chosen.second.z()) > half) return result;
  Helix helix(radius, chosen.long_way, compat);
  result.arc_length_m = helix.settle(p, q, single, chosen.first, chosen.second);
  result.action = action;
  result.has_points = true;
  result.first_W = chosen.first;
  result.second_W = chosen.second;
  return result;
}

}  // namespace myoid::body
