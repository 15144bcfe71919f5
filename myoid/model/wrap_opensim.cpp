#include "myoid/model/wrap_opensim.h"

#include <cmath>
#include <limits>

#include "myoid/core/units.h"
#include "myoid/model/wrap_opensim_ellipsoid.h"

namespace myoid::model {
namespace {

/// Sign as OpenSim takes it: zero is positive.
int sign_of(double x) { return x >= 0.0 ? 1 : -1; }

Vec3 unit_or_zero(const Vec3& v) {
  const double n = v.norm();
  return n > 0.0 ? Vec3(v / n) : Vec3::Zero();
}

/// Which side counts: axis 0..2 and sign, sign 0 for all sides.
struct Side {
  Eigen::Index axis = 0;
  int sign = 0;

  explicit Side(Quadrant quadrant)
      : axis(quadrant == 0 ? 0 : std::abs(quadrant) - 1),
        sign(quadrant == 0 ? 0 : (quadrant > 0 ? 1 : -1)) {}
  [[nodiscard]] bool has(const Vec3& p) const { return sign_of(p[axis]) == sign; }
};

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

/// The tangent points on one circle, counterclockwise (a) and clockwise (b).
struct Tangents {
  Vec3 a, b;
};

/// In the plane across z through p: feet of the tangents from p to the cylinder.
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

/// Where the generator through r meets the plane; as r if it does not within 10 m.
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

/// Length of the helix from first to second, adjusting both where asked; `long_way` as OpenSim
/// decides it.
class Helix {
 public:
  Helix(double radius, bool long_way, const Compat& compat)
      : radius_(radius), long_way_(long_way), compat_(compat) {}

  double settle(const Vec3& p, const Vec3& q, bool single, Vec3& first, Vec3& second) {
    constexpr int kMostSlides = 100;
    constexpr double kChord_m = 0.002;
    measure(first, second);
    for (int slides = 0; !single && slides < kMostSlides; ++slides) {
      const int pieces = static_cast<int>(length_ / kChord_m);
      if (!(length_ < 1e6) || pieces < 2) break;
      const double t = 1.0 / pieces;
      // The second is corrected with what the first has become.
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
    theta_ = std::atan2(first.x() * second.y() - first.y() * second.x(),
                        first.x() * second.x() + first.y() * second.y());
    if (long_way_) {
      theta_ =
          compat_.long_turn_of_negative_angle ? 2.0 * kPi - theta_ : 2.0 * kPi - std::abs(theta_);
    }
    length_ = std::sqrt(radius_ * theta_ * (radius_ * theta_) + rise_ * rise_);
  }
  [[nodiscard]] Vec3 point(const Vec3& first, double t) const {
    const double angle = (long_way_ ? -1.0 : 1.0) * t * theta_;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * first.x() - s * first.y(), s * first.x() + c * first.y(), first.z() + t * rise_};
  }
  /// Slides r along z so that the angle of end - r to the axis comes near that of r - on_helix.
  static bool slide(const Vec3& end, const Vec3& on_helix, Vec3& r) {
    constexpr double kTangency_rad = 0.1 * kDegree;
    const double straight = unit_or_zero(r - end).z();
    const double curved = unit_or_zero(on_helix - r).z();
    // Angles differ by more than their cosines do.
    if (!(std::abs(straight - curved) > kTangency_rad) &&
        !(std::abs(std::acos(straight) - std::acos(curved)) > kTangency_rad))
      return false;
    const NearestOfLines n = nearest_of_lines(end, on_helix, Vec3(r.x(), r.y(), end.z()),
                                              Vec3(r.x(), r.y(), on_helix.z()));
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

/// The pair of tangent points on the side that counts.
ChosenTangents choose_on_side(
    const Side& side, const Tangents& t1, const Tangents& t2, const Vec3& p, const Vec3& q) {
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

ChosenTangents choose_nearest(const Tangents& t1,
                              const Tangents& t2,
                              const Vec3& p,
                              const Vec3& q) {
  const Vec3 foot1(0.0, 0.0, p.z());
  const Vec3 foot2(0.0, 0.0, q.z());
  const Vec3 a1 = unit_or_zero(t1.a - foot1);
  const Vec3 b1 = unit_or_zero(t1.b - foot1);
  const Vec3 a2 = unit_or_zero(t2.a - foot2);
  const Vec3 b2 = unit_or_zero(t2.b - foot2);
  const double aa = a1.dot(a2);
  const double ab = a1.dot(b2);
  const double ba = b1.dot(a2);
  const double bb = b1.dot(b2);
  ChosenTangents c;
  if (aa > ab && aa > ba && aa > bb) {
    c.first = t1.a;
    c.second = t2.a;
  } else if (ab > ba && ab > bb) {
    c.first = t1.a;
    c.second = t2.b;
  } else if (ba > bb) {
    c.first = t1.b;
    c.second = t2.a;
  } else {
    c.first = t1.b;
    c.second = t2.b;
  }
  return c;
}

/// Moves the tangent points, found across the axis, along their generators into the plane through
/// p, q and the apex of the path over the cylinder.
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
  // A point moves only if its foot on the axis lies towards the other end.
  const auto foot_of = [&](const Vec3& r) { return q.z() != 0.0 ? Vec3(0.0, 0.0, r.z()) : foot1; };
  const double between = (foot1 - foot2).squaredNorm();
  Vec3 moved;
  const bool first_meets = meets_plane(c.first, normal, offset, moved);
  Vec3 second_moved;
  const bool second_meets = meets_plane(c.second, normal, offset, second_moved);
  if (first_meets && (foot_of(moved) - foot2).squaredNorm() < between) c.first = moved;
  if (second_meets && (foot_of(second_moved) - foot1).squaredNorm() < between)
    c.second = second_moved;
}

OpenSimContact contact(const CylinderShape& cylinder,
                       const Side& side,
                       const Vec3& p,
                       const Vec3& q,
                       bool single,
                       const Compat& compat) {
  OpenSimContact result;
  const double radius = cylinder.radius_m;
  const double r2 = radius * radius;
  if (p.head<2>().squaredNorm() < r2 || q.head<2>().squaredNorm() < r2) {
    result.action = WrapAction::inside;
    return result;
  }
  const double half = 0.5 * cylinder.length_m;
  const NearestOfLines near = nearest_of_lines(p, q, Vec3(0.0, 0.0, -half), Vec3(0.0, 0.0, half));
  const bool hit = !near.parallel && (near.on_first - near.on_second).squaredNorm() < r2 &&
                   near.share > 0.0 && near.share < 1.0;
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
  ChosenTangents chosen =
      side.sign != 0 ? choose_on_side(side, t1, t2, p, q) : choose_nearest(t1, t2, p, q);
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

OpenSimContact contact(const SphereShape& sphere,
                       const Side& side,
                       const Vec3& p,
                       const Vec3& q,
                       const Compat& compat) {
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
    // The line goes through the center: OpenSim's points are not a number, and never chosen.
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
  const Vec3 a1 = t1.a.normalized();
  const Vec3 b1 = t1.b.normalized();
  const Vec3 a2 = t2.a.normalized();
  const Vec3 b2 = t2.b.normalized();
  const double aa = a1.dot(a2);
  const double ab = a1.dot(b2);
  const double ba = b1.dot(a2);
  const double bb = b1.dot(b2);
  bool first_is_a = true;
  bool second_is_a = true;
  if (aa > ab && aa > ba && aa > bb) {
  } else if (ab > ba && ab > bb) {
    second_is_a = false;
  } else if (ba > bb) {
    first_is_a = false;
  } else {
    first_is_a = second_is_a = false;
  }
  result.action = WrapAction::wrapped;
  bool far_side = false;
  const auto first = [&] { return first_is_a ? t1.a : t1.b; };
  const auto second = [&] { return second_is_a ? t2.a : t2.b; };
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
      first_is_a = a1.dot(inward) > b1.dot(inward);
      second_is_a = a2.dot(inward) > b2.dot(inward);
      const Vec3 sum = (first() - p) + (second() - q);
      if (side.sign * sum[side.axis] < 0.0) {
        first_is_a = !first_is_a;
        second_is_a = !second_is_a;
      }
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

/// MINPACK's Levenberg-Marquardt for one residual of one variable, with the constants that OpenSim
/// gives it. Returns the variable.
template <typename Residual>
double levenberg_marquardt_1(const Residual& residual) {
  constexpr double kTolerance = 1e-4;
  constexpr double kStep = 1e-5;
  constexpr double kFactor = 0.2;
  constexpr int kMostCalls = 500;
  constexpr double kTiny = 2.2250738585072014e-308;
  double x = 0.0;
  double f = residual(x);
  double norm = std::abs(f);
  double par = 0.0;
  double diag = 0.0;
  double delta = 0.0;
  double x_norm = 0.0;
  int calls = 1;
  for (int iteration = 1;; ++iteration) {
    const double slope = (residual(x + kStep) - f) / kStep;
    ++calls;
    if (iteration == 1) {
      diag = slope != 0.0 ? std::abs(slope) : 1.0;
      x_norm = std::abs(diag * x);
      delta = x_norm != 0.0 ? kFactor * x_norm : kFactor;
    }
    if (norm == 0.0 || slope == 0.0) return x;
    diag = std::max(diag, std::abs(slope));
    for (double ratio = 0.0; ratio < 1e-4;) {
      // The step whose scaled length is delta within a tenth, or the full one.
      double step = f / slope;
      double scaled = std::abs(diag * step);
      double excess = scaled - delta;
      if (excess <= 0.1 * delta) {
        par = 0.0;
      } else {
        const double t = diag / std::abs(slope);
        double lower = excess / delta / t / t;
        const double gradient = std::abs(slope * f / diag);
        double upper = gradient / delta;
        if (upper == 0.0) upper = kTiny / std::min(delta, 0.1);
        par = std::min(std::max(par, lower), upper);
        if (par == 0.0) par = gradient / scaled;
        for (int k = 1;; ++k) {
          if (par == 0.0) par = std::max(kTiny, 0.001 * upper);
          const double damped = slope * slope + par * diag * diag;
          step = slope * f / damped;
          scaled = std::abs(diag * step);
          const double before = excess;
          excess = scaled - delta;
          if (std::abs(excess) <= 0.1 * delta ||
              (lower == 0.0 && excess <= before && before < 0.0) || k == 10)
            break;
          const double w = diag / std::sqrt(damped);
          const double correction = excess / delta / w / w;
          if (excess > 0.0) lower = std::max(lower, par);
          if (excess < 0.0) upper = std::min(upper, par);
          par = std::max(lower, par + correction);
        }
      }
      const double trial = x - step;
      const double length = std::abs(diag * step);
      if (iteration == 1) delta = std::min(delta, length);
      const double f_trial = residual(trial);
      ++calls;
      const double norm_trial = std::abs(f_trial);
      const double actual =
          0.1 * norm_trial < norm ? 1.0 - (norm_trial / norm) * (norm_trial / norm) : -1.0;
      const double t1 = std::abs(slope * step) / norm;
      const double t2 = std::sqrt(par) * length / norm;
      const double predicted = t1 * t1 + t2 * t2 / 0.5;
      const double direction = -(t1 * t1 + t2 * t2);
      ratio = predicted != 0.0 ? actual / predicted : 0.0;
      if (ratio <= 0.25) {
        double shrink = actual >= 0.0 ? 0.5 : 0.5 * direction / (direction + 0.5 * actual);
        if (0.1 * norm_trial >= norm || shrink < 0.1) shrink = 0.1;
        delta = shrink * std::min(delta, length / 0.1);
        par /= shrink;
      } else if (par == 0.0 || ratio >= 0.75) {
        delta = length / 0.5;
        par *= 0.5;
      }
      if (ratio >= 1e-4) {
        x = trial;
        x_norm = std::abs(diag * x);
        f = f_trial;
        norm = norm_trial;
      }
      if (std::abs(actual) <= kTolerance && predicted <= kTolerance && 0.5 * ratio <= 1.0) return x;
      if (delta <= kTolerance * x_norm || calls >= kMostCalls || !std::isfinite(norm)) return x;
    }
  }
}

/// Point of the circle of radius R about z in z = 0 that is nearest to the line from `begin`, as
/// OpenSim finds it.
struct NearCircle {
  Vec3 on_line;
  double distance = 0.0;
};
NearCircle near_circle(const Vec3& begin, const Vec3& end, double R, const Compat& compat) {
  const Vec3 n = (end - begin).normalized();
  const double c2 = 2.0 * begin.dot(n);
  const double c3 = begin.head<2>().dot(n.head<2>());
  const double c4 = n.head<2>().squaredNorm();
  const double c5 = begin.head<2>().squaredNorm();
  const double factor = compat.approximate_torus ? 2.0 : 1.0;
  const double u = levenberg_marquardt_1([&](double s) {
    return c2 + 2.0 * s -
           2.0 * R * factor * (c4 * s + c3) / std::sqrt(s * s * c4 + 2.0 * c3 * s + c5);
  });
  NearCircle near;
  near.on_line = begin + u * n;
  near.distance =
      std::sqrt(near.on_line.squaredNorm() + R * R - 2.0 * R * near.on_line.head<2>().norm());
  return near;
}

OpenSimContact contact(const TorusShape& torus,
                       const Side& side,
                       const Vec3& p,
                       const Vec3& q,
                       bool single,
                       const Compat& compat) {
  constexpr double kLong_m = 10000.0;
  OpenSimContact result;
  const NearCircle forth = near_circle(p, q, torus.outer_radius_m, compat);
  const NearCircle back = near_circle(q, p, torus.outer_radius_m, compat);
  bool take_forth = forth.distance < back.distance;
  if (side.sign != 0) {
    const bool forth_counts = side.has(forth.on_line);
    const bool back_counts = side.has(back.on_line);
    if (!forth_counts && !back_counts) return result;
    if (forth_counts != back_counts) take_forth = forth_counts;
  }
  const Vec3& chosen = take_forth ? forth.on_line : back.on_line;
  const Vec3 on_circle =
      Vec3(chosen.x(), chosen.y(), 0.0) * (torus.outer_radius_m / chosen.head<2>().norm());
  // A cylinder along the circle there; its x axis points to the middle of the ring.
  Mat3 R;
  R.row(0) = -on_circle.normalized();
  R.row(1) = -Vec3::UnitZ();
  R.row(2) = R.row(0).cross(R.row(1));
  const OpenSimContact c = contact(CylinderShape{torus.inner_radius_m, kLong_m}, Side(1),
                                   R * (p - on_circle), R * (q - on_circle), single, compat);
  result = c;
  result.action = WrapAction::wrapped;
  result.first_W = R.transpose() * c.first_W + on_circle;
  result.second_W = R.transpose() * c.second_W + on_circle;
  return result;
}

}  // namespace

OpenSimContact opensim_contact(const WrapObject& object,
                               WrapMethod method,
                               const Vec3& p_W,
                               const Vec3& q_W,
                               bool single,
                               const Compat& compat) {
  const Side side(object.quadrant);
  if (const auto* cylinder = std::get_if<CylinderShape>(&object.shape))
    return contact(*cylinder, side, p_W, q_W, single, compat);
  if (const auto* sphere = std::get_if<SphereShape>(&object.shape))
    return contact(*sphere, side, p_W, q_W, compat);
  if (const auto* torus = std::get_if<TorusShape>(&object.shape))
    return contact(*torus, side, p_W, q_W, single, compat);
  return opensim_ellipsoid_contact(std::get<EllipsoidShape>(object.shape), object.quadrant, method,
                                   p_W, q_W, compat);
}

}  // namespace myoid::model
