#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "myoid/body/model/opensim_defects/wrap_opensim_surfaces.h"
#include "myoid/body/model/wrap_surfaces.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

constexpr double kNearZero = 2e-13;
constexpr int kFanSamples = 300;
using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;

bool near_zero(double x) { return std::abs(x) <= kNearZero; }

/// Finds the point of the ellipse x^2/a^2 + y^2/b^2 = 1 nearest to (u, v) by Eberly's iteration.
void nearest_on_ellipse(double a, double b, double u, double v, double& x, double& y) {
  const double a2 = a * a;
  const double b2 = b * b;
  if (near_zero(u) && near_zero(v)) {
    if (a < b) {
      x = u < 0.0 ? -a : a;
      y = v;
    } else {
      x = u;
      y = v < 0.0 ? -b : b;
    }
    return;
  }
  if (near_zero(u)) {
    if (a >= b || std::abs(v) >= b - a2 / b) {
      x = u;
      y = v >= 0.0 ? b : -b;
    } else {
      y = b2 * v / (b2 - a2);
      x = a * std::sqrt(std::abs(1.0 - y / b * (y / b)));
    }
    return;
  }
  if (near_zero(v)) {
    if (b >= a || std::abs(u) >= a - b2 / a) {
      x = u >= 0.0 ? a : -a;
      y = v;
    } else {
      x = a2 * u / (a2 - b2);
      y = b * std::sqrt(std::abs(1.0 - x / a * (x / a)));
    }
    return;
  }
  const bool inside = u / a * (u / a) + v / b * (v / b) < 1.0;
  double t = inside ? 0.0 : std::max(a, b) * std::sqrt(u * u + v * v);
  const double au = a2 * u * u;
  const double bv = b2 * v * v;
  double P = 0.0;
  double Q = 0.0;
  for (int i = 0; i < 64; ++i) {
    P = t + a2;
    Q = t + b2;
    const double f = P * P * Q * Q - au * Q * Q - bv * P * P;
    if (std::abs(f) < 1e-9) break;
    t -= f / (2.0 * (P * Q * (P + Q) - au * Q - bv * P));
  }
  x = a2 * u / P;
  y = b2 * v / Q;
}

/// Returns the point of the ellipsoid nearest to p, within the plane where coordinate `plane`
/// equals p's if `plane` is given or p is on a plane of symmetry.
Vec3 nearest(const Vec3& a, const Vec3& p, Eigen::Index plane = -1) {
  Vec3 c = p;
  if (plane < 0) {
    double smallest = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (!near_zero(p[i])) continue;
      const double sum = a.sum() - a[i];
      if (smallest > sum) {
        plane = i;
        smallest = sum;
      }
    }
  }
  if (plane >= 0) {
    const Eigen::Index i = (plane + 1) % 3;
    const Eigen::Index j = (plane + 2) % 3;
    nearest_on_ellipse(a[i], a[j], p[i], p[j], c[i], c[j]);
    return c;
  }
  const Vec3 a2 = a.cwiseProduct(a);
  const Vec3 ap = a2.cwiseProduct(p.cwiseProduct(p));
  double t = p.cwiseQuotient(a).squaredNorm() < 1.0 ? 0.0 : a.maxCoeff() * p.norm();
  for (int i = 0; i < 64; ++i) {
    const double P = t + a2[0];
    const double Q = t + a2[1];
    const double R = t + a2[2];
    const double P2 = P * P;
    const double Q2 = Q * Q;
    const double R2 = R * R;
    const double f = P2 * Q2 * R2 - ap[0] * Q2 * R2 - ap[1] * P2 * R2 - ap[2] * P2 * Q2;
    if (std::abs(f) < 1e-9) return {a2[0] * p[0] / P, a2[1] * p[1] / Q, a2[2] * p[2] / R};
    const double PQ = P * Q;
    const double PR = P * R;
    const double QR = Q * R;
    const double slope =
        2.0 * (P * Q * R * (QR + PR + PQ) - ap[0] * QR * (Q + R) - ap[1] * PR * (P + R) - ap[2] * PQ * (P + Q));
    t -= f / slope;
  }
  return c;
}

/// Plane n . x + d = 0.
struct Plane {
  Vec3 n;
  double d = 0.0;
};

/// Moves r on the ellipsoid within the plane until the line to p touches: a damped least-squares
/// iteration on four residuals (plane, surface, tangent plane through r and through p).
class TangentSearch {
 public:
  TangentSearch(const Vec3& a, const Vec3& p, const Plane& plane) : a_(a), p_(p), plane_(plane) {}

  Vec3 run(Vec3 r) {
    constexpr double kTolerance = 1e-8;
    constexpr int kMost = 50;
    constexpr int kMostInner = 1000;
    r_ = r;
    d_ = -normal().dot(r_);
    double alpha = 0.01;
    double before = evaluate();
    double now = before;
    for (int iteration = 0; now > kTolerance && iteration < kMost; ++iteration) {
      Mat4 J;
      for (Eigen::Index i = 0; i < 3; ++i) {
        const double square = a_[i] * a_[i];
        J.row(i) << plane_.n[i], 2.0 * r_[i] / square, 4.0 * r_[i] / square, 2.0 * p_[i] / square;
      }
      J.row(3) << 0.0, 0.0, 1.0, 1.0;
      const double cosine = (p_ - r_).normalized().dot(p_.normalized());
      const double damping = cosine > 0.1 ? 1.0 - std::pow(cosine, 100) : 1.0;
      const Vec4 descent = -J * e_;
      Mat4 normal_matrix = J * J.transpose();
      const Vec4 diagonal = normal_matrix.diagonal();
      Vec4 step = Vec4::Zero();
      for (int inner = 0; now >= before && inner < kMostInner; ++inner) {
        normal_matrix.diagonal() = diagonal * (1.0 + alpha);
        step = damping / 16.0 * normal_matrix.partialPivLu().solve(descent);
        move(step);
        before = now;
        now = evaluate();
        alpha *= 4.0;
      }
      alpha /= 8.0;
      double stretch = 0.5;
      for (int inner = 0; now <= before && inner < kMostInner; ++inner) {
        stretch *= 2.0;
        move(step * stretch);
        before = now;
        now = evaluate();
      }
      move(-step * stretch);
      now = evaluate();
      before = now;
    }
    return r_;
  }

 private:
  [[nodiscard]] Vec3 normal() const { return 2.0 * r_.cwiseQuotient(a_.cwiseProduct(a_)); }
  void move(const Vec4& step) {
    r_ += step.head<3>();
    d_ += step[3];
  }
  double evaluate() {
    const Vec3 n = normal();
    e_ << plane_.n.dot(r_) + plane_.d, r_.cwiseQuotient(a_).squaredNorm() - 1.0, n.dot(r_) + d_, n.dot(p_) + d_;
    return e_.squaredNorm();
  }
  const Vec3& a_;
  const Vec3& p_;
  const Plane& plane_;
  Vec3 r_ = Vec3::Zero();
  double d_ = 0.0;
  Vec4 e_ = Vec4::Zero();
};

/// The polyline from r1 to r2 over the ellipsoid, in the plane: its length, and its first and last
/// inner points if it has more than two points.
struct Polyline {
  double length = 0.0;
  bool has_inner = false;
  Vec3 after_first, before_last;
};

Polyline polyline(const Vec3& r1, const Vec3& r2, const Vec3& a, const Plane& plane, bool far_side, double factor) {
  constexpr double kChord_m = 0.001;
  Polyline line;
  const double chord_m = (r1 - r2).norm() / factor;
  if (chord_m < kChord_m) {
    line.length = chord_m * factor;
    return line;
  }
  const int pieces = chord_m < 1e3 ? std::min(static_cast<int>(chord_m / kChord_m), 499) : 499;
  Eigen::Index greatest = 0;
  plane.n.cwiseAbs().maxCoeff(&greatest);
  const Vec3 center = -plane.d / plane.n[greatest] * Vec3::Unit(greatest);
  const Vec3 u = (r1 - center).normalized();
  const Vec3 w = (r2 - center).normalized();
  const double angle = std::acos(u.dot(w));
  const double step = (far_side ? -(2.0 * kPi - angle) : angle) / pieces;
  const Vec3 v = u.cross(w).normalized().cross(u);
  const Vec3 f2 = center.cwiseQuotient(a);
  const double cc = f2.squaredNorm() - 1.0;
  Vec3 last = r1;
  const double turn_c = std::cos(step);
  const double turn_s = std::sin(step);
  double c = 1.0;  // cosine and sine of i steps
  double sine = 0.0;
  for (int i = 1; i < pieces; ++i) {
    const double before = c;
    c = c * turn_c - sine * turn_s;
    sine = sine * turn_c + before * turn_s;
    const Vec3 ray = c * u + sine * v;
    const Vec3 f1 = ray.cwiseQuotient(a);
    const double aa = f1.squaredNorm();
    const double bb = 2.0 * f1.dot(f2);
    const Vec3 s = center + (-bb + std::sqrt(bb * bb - 4.0 * aa * cc)) / (2.0 * aa) * ray;
    if (i == 1) line.after_first = s;
    if (i == pieces - 1) line.before_last = s;
    line.length += (s - last).norm();
    last = s;
  }
  line.has_inner = pieces > 1;
  line.length += (r2 - last).norm();
  return line;
}

/// The point c that defines the plane, and the start of the search for tangent points.
struct PlanePoint {
  Vec3 c, start1, start2;
};

PlanePoint plane_point(const Vec3& a,
                       Quadrant quadrant,
                       WrapMethod method,
                       const Vec3& p,
                       const Vec3& q,
                       const Vec3& r1,
                       const Vec3& r2,
                       const Compat& compat) {
  const Vec3 chord = r2 - r1;
  Vec3 mu = (q - p).normalized().cwiseAbs();
  Eigen::Index best = 0;
  mu.maxCoeff(&best);
  const double t = -r1[best] / chord[best];
  double fan_weight = -std::numeric_limits<double>::infinity();
  PlanePoint result{Vec3::Zero(), r1, r2};
  Vec3& c = result.c;
  if (method == WrapMethod::midpoint) {
    c = nearest(a, r1 + 0.5 * chord);
  } else {
    if (method == WrapMethod::hybrid && mu[best] > kBlendMin) {
      double inside = 1.0;
      if (t < 0.0 || t > 1.0) {
        inside = 0.0;
      } else if (t < kBoundary) {
        inside = t / kBoundary;
      } else if (t > 1.0 - kBoundary) {
        inside = (1.0 - t) / kBoundary;
      }
      if (inside < 1.0) mu[best] = kBlendMin + inside * (mu[best] - kBlendMin);
    }
    if (method == WrapMethod::axial || mu[best] > kBlendMin) c = nearest(a, r1 + t * chord, best);
    if (method == WrapMethod::hybrid && mu[best] < kBlendMax) {
      Vec3 sum = Vec3::Zero();
      for (int i = 1; i < kFanSamples - 1; ++i) {
        const Vec3 s = r1 + static_cast<double>(i) / kFanSamples * chord;
        sum += (nearest(a, s) - s).normalized();
      }
      const Vec3 fan = r1 + 0.5 * chord + sum.normalized();
      if (mu[best] <= kBlendMin) {
        c = nearest(a, fan);
        fan_weight = 1.0;
      } else {
        const double share = (mu[best] - kBlendMin) / (kBlendMax - kBlendMin);
        c = nearest(a, share * c + (1.0 - share) * nearest(a, fan));
        fan_weight = 1.0 - share;
      }
    }
  }
  if (method != WrapMethod::axial || (t > 0.0 && t < 1.0)) result.start1 = result.start2 = c;
  if (quadrant != 0) {
    const Eigen::Index axis = std::abs(quadrant) - 1;
    if ((c[axis] >= 0.0 ? 1 : -1) != (quadrant > 0 ? 1 : -1)) {
      const double original = c[axis];
      c[axis] = -original;
      result.start1 = result.start2 = c;
      if (!compat.mirrored_without_fan && std::isinf(fan_weight))
        fan_weight = 1.0 - (mu[best] - kBlendMin) / (kBlendMax - kBlendMin);
      fan_weight = std::min(fan_weight, 1.0);
      if (fan_weight > 0.0) {
        c[axis] += fan_weight * (0.5 * (original + c[axis]) - c[axis]);
        c = nearest(a, c);
      }
    }
  }
  return result;
}

}  // namespace

OpenSimContact opensim_ellipsoid_contact(const EllipsoidShape& ellipsoid,
                                         Quadrant quadrant,
                                         WrapMethod method,
                                         const Vec3& p_W,
                                         const Vec3& q_W,
                                         const Compat& compat) {
  OpenSimContact result;
  const double factor = 3.0 / ellipsoid.radii_m.sum();
  const Vec3 p = p_W * factor;
  const Vec3 q = q_W * factor;
  const Vec3 a = ellipsoid.radii_m * factor;
  const double p_level = p.cwiseQuotient(a).squaredNorm() - 1.0;
  const double q_level = q.cwiseQuotient(a).squaredNorm() - 1.0;
  if (p_level < -0.0001 || q_level < -0.0001) {
    result.action = WrapAction::inside;
    return result;
  }
  if (std::abs(p.normalized().dot(q.normalized()) - 1.0) < 0.0001) return result;
  const Vec3 along = p - q;
  const Vec3 f1 = along.cwiseQuotient(a);
  const Vec3 f2 = q.cwiseQuotient(a);
  const double aa = f1.squaredNorm();
  const double bb = 2.0 * f1.dot(f2);
  const double cc = f2.squaredNorm() - 1.0;
  const double discriminant = bb * bb - 4.0 * aa * cc;
  if (discriminant < 0.0) return result;
  const double l1 = (-bb + std::sqrt(discriminant)) / (2.0 * aa);
  const double l2 = (-bb - std::sqrt(discriminant)) / (2.0 * aa);
  if (!(0.0 < l1 && l1 < 1.0) || !(0.0 < l2 && l2 < 1.0)) return result;
  const PlanePoint point = plane_point(a, quadrant, method, p, q, q + l1 * along, q + l2 * along, compat);
  Plane plane;
  plane.n = along.cross(p - point.c).normalized();
  plane.d = -plane.n.dot(point.c);
  const auto tangent = [&](const Vec3& end, double level, const Vec3& start) -> Vec3 {
    return std::abs(level) < 0.0001 ? end : TangentSearch(a, end, plane).run(start);
  };
  const Vec3 r1 = tangent(p, p_level, point.start1);
  const Vec3 r2 = tangent(q, q_level, point.start2);
  Polyline line = polyline(r1, r2, a, plane, false, factor);
  if (quadrant != 0 && line.has_inner) {
    // A first or last chord that turns back shows that the path goes round the far side.
    const double first = (p - r1).normalized().dot((line.after_first - r1).normalized());
    const double last = (q - r2).normalized().dot((line.before_last - r2).normalized());
    if (first > 0.0 || last > 0.0) line = polyline(r1, r2, a, plane, true, factor);
  }
  result.action = WrapAction::mandatory;
  result.has_points = true;
  result.first_W = r1 / factor;
  result.second_W = r2 / factor;
  result.arc_length_m = line.length / factor;
  return result;
}

}  // namespace myoid::body
