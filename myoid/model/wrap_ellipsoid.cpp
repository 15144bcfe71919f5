#include "myoid/model/wrap_ellipsoid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "myoid/core/units.h"

namespace myoid::model {
namespace {

/// Where the straight line runs inside the ellipsoid.
struct Chord {
  Vec3 begin = Vec3::Zero();
  Vec3 end = Vec3::Zero();
  [[nodiscard]] Vec3 at(double t) const { return begin + t * (end - begin); }
};

std::optional<Chord> chord_inside(const Vec3& radii, const Vec3& p, const Vec3& q) {
  // In coordinates where the ellipsoid is the unit sphere, |p + t (q - p)| = 1.
  const Vec3 P = p.cwiseQuotient(radii);
  const Vec3 d = (q - p).cwiseQuotient(radii);
  constexpr double kInside = -1e-4;  // OpenSim's: ends may touch the surface
  if (P.squaredNorm() - 1.0 < kInside || (P + d).squaredNorm() - 1.0 < kInside) return std::nullopt;
  if (std::abs(p.normalized().dot(q.normalized()) - 1.0) < 1e-4) return std::nullopt;
  const double a = d.squaredNorm();
  const double b = P.dot(d);
  const double discriminant = b * b - a * (P.squaredNorm() - 1.0);
  if (discriminant < 0.0) return std::nullopt;
  const double enter = (-b - std::sqrt(discriminant)) / a;
  const double leave = (-b + std::sqrt(discriminant)) / a;
  if (!(enter > 0.0 && leave < 1.0)) return std::nullopt;
  return Chord{p + enter * (q - p), p + leave * (q - p)};
}

/// Nearest to the chord's middle moved out by the mean radius in the mean direction from the chord
/// to the surface.
Vec3 fan_point(const Vec3& radii, const Chord& chord) {
  constexpr int kBlades = 300;
  Vec3 direction = Vec3::Zero();
  for (int i = 1; i < kBlades - 1; ++i) {
    const Vec3 s = chord.at(static_cast<double>(i) / kBlades);
    direction += (closest_point_on_ellipsoid(radii, s) - s).normalized();
  }
  return closest_point_on_ellipsoid(radii, chord.at(0.5) + radii.mean() * direction.normalized());
}

/// The point c of the surface that the wrapping plane goes through.
Vec3 plane_point(const Vec3& radii,
                 Quadrant quadrant,
                 WrapMethod method,
                 const Vec3& along,
                 const Chord& chord) {
  constexpr double kBlendMin = 0.7073;
  constexpr double kBlendMax = 0.9;
  constexpr double kBoundary = 0.3;
  double fan_weight = 0.0;
  Vec3 c;
  if (method == WrapMethod::midpoint) {
    c = closest_point_on_ellipsoid(radii, chord.at(0.5));
  } else {
    int axis = 0;
    double parallel = along.normalized().cwiseAbs().maxCoeff(&axis);
    const double t = -chord.begin[axis] / (chord.end[axis] - chord.begin[axis]);
    if (method == WrapMethod::hybrid) {
      // The crossing must lie well within the chord; towards its ends the axial point fades out.
      if (parallel > kBlendMin) {
        const double inside = std::clamp(std::min(t, 1.0 - t) / kBoundary, 0.0, 1.0);
        parallel = kBlendMin + inside * (parallel - kBlendMin);
      }
      fan_weight = std::clamp((kBlendMax - parallel) / (kBlendMax - kBlendMin), 0.0, 1.0);
    }
    if (fan_weight < 1.0) c = closest_point_on_ellipsoid(radii, chord.at(t), axis);
    if (fan_weight == 1.0) {
      c = fan_point(radii, chord);
    } else if (fan_weight > 0.0) {
      c = closest_point_on_ellipsoid(radii,
                                     (1.0 - fan_weight) * c + fan_weight * fan_point(radii, chord));
    }
  }
  if (quadrant != 0) {
    const Eigen::Index axis = std::abs(quadrant) - 1;
    const double side = quadrant > 0 ? 1.0 : -1.0;
    if ((c[axis] >= 0.0 ? 1.0 : -1.0) != side) {
      // Mirrored, then drawn back towards the plane of symmetry by the share of the fan.
      c[axis] *= fan_weight - 1.0;
      if (fan_weight > 0.0) c = closest_point_on_ellipsoid(radii, c);
    }
  }
  return c;
}

}  // namespace

Vec3 closest_point_on_ellipsoid(const Vec3& radii_m, const Vec3& p, int plane) {
  // x_i = a_i^2 p_i / (t + a_i^2), with t the largest root of g(t) = sum (a_i p_i / (t + a_i^2))^2
  // - 1. g falls and is convex there: Newton from a point left of the root converges from the left.
  constexpr double kOnPlane = 1e-13;
  std::array<bool, 3> used{};
  double shortest = std::numeric_limits<double>::infinity();
  double lowest = -std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const bool is_used = i != plane && std::abs(p[i]) > kOnPlane * radii_m[i];
    used[static_cast<std::size_t>(i)] = is_used;
    if (i != plane) shortest = std::min(shortest, radii_m[i]);
    if (is_used) lowest = std::max(lowest, radii_m[i] * (std::abs(p[i]) - radii_m[i]));
  }
  Vec3 x = Vec3::Zero();
  if (!(used[0] || used[1] || used[2])) {
    // At the center: the end of the shortest axis.
    for (Eigen::Index i = 2; i >= 0; --i) {
      if (i != plane && radii_m[i] == shortest) {
        x.setZero();
        x[i] = radii_m[i];
      }
    }
    return x;
  }
  double t = lowest;
  for (int iteration = 0; iteration < 100; ++iteration) {
    double g = -1.0;
    double slope = 0.0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (!used[static_cast<std::size_t>(i)]) continue;
      const double part = radii_m[i] * p[i] / (t + radii_m[i] * radii_m[i]);
      g += part * part;
      slope -= 2.0 * part * part / (t + radii_m[i] * radii_m[i]);
    }
    const double step = -g / slope;
    t += step;
    if (std::abs(step) <= 1e-15 * (std::abs(t) + shortest * shortest)) break;
  }
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (used[static_cast<std::size_t>(i)])
      x[i] = radii_m[i] * radii_m[i] * p[i] / (t + radii_m[i] * radii_m[i]);
  }
  return x;
}

std::optional<WrapContact> wrap_ellipsoid(const EllipsoidShape& ellipsoid,
                                          Quadrant quadrant,
                                          WrapMethod method,
                                          const Vec3& p_W,
                                          const Vec3& q_W) {
  const Vec3& radii = ellipsoid.radii_m;
  const std::optional<Chord> chord = chord_inside(radii, p_W, q_W);
  if (!chord) return std::nullopt;
  const Vec3 c = plane_point(radii, quadrant, method, q_W - p_W, *chord);

  // Where the ellipsoid is the unit sphere, planes stay planes and tangents stay tangents, and the
  // cut is a circle.
  const Vec3 P = p_W.cwiseQuotient(radii);
  const Vec3 Q = q_W.cwiseQuotient(radii);
  const Vec3 C = c.cwiseQuotient(radii);
  const Vec3 u = (Q - P).normalized();
  Vec3 v = (C - P) - (C - P).dot(u) * u;
  if (!(v.norm() > 1e-12)) return std::nullopt;  // c on the line: no plane
  v.normalize();  // towards c: the path bulges to +v and turns from v to u
  const Vec3 normal = u.cross(v);
  const Vec3 center = P.dot(normal) * normal;
  const double radius = std::sqrt(std::max(1.0 - center.squaredNorm(), 0.0));
  const auto polar = [&](const Vec3& X) {
    return std::atan2((X - center).dot(v), (X - center).dot(u));
  };
  const auto to_tangent = [&](const Vec3& X) {
    return std::acos(std::min(radius / (X - center).norm(), 1.0));
  };
  const double first = polar(P) - to_tangent(P);
  const double last = polar(Q) + to_tangent(Q);
  double turned = std::fmod(first - last, 2.0 * kPi);
  if (turned < 0.0) turned += 2.0 * kPi;
  const auto on_cut = [&](double angle) -> Vec3 {
    return (center + radius * (std::cos(angle) * u + std::sin(angle) * v)).cwiseProduct(radii);
  };

  WrapContact contact;
  contact.first_W = on_cut(first);
  contact.second_W = on_cut(last);
  // Length of the ellipse's arc: Gauss-Legendre of order 6 on pieces of at most pi/16; the
  // integrand is smooth.
  constexpr std::array<double, 3> kNode{0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
  constexpr std::array<double, 3> kWeight{0.4679139345726910, 0.3607615730481386,
                                          0.1713244923791704};
  const int pieces = 1 + static_cast<int>(turned * 16.0 / kPi);
  const double half = 0.5 * turned / pieces;
  const auto speed = [&](double angle) {
    return (radius * (-std::sin(angle) * u + std::cos(angle) * v)).cwiseProduct(radii).norm();
  };
  for (int i = 0; i < pieces; ++i) {
    const double middle = first - half * (2 * i + 1);
    for (std::size_t k = 0; k < 3; ++k) {
      contact.arc_length_m +=
          half * kWeight[k] * (speed(middle - half * kNode[k]) + speed(middle + half * kNode[k]));
    }
  }
  return contact;
}

}  // namespace myoid::model
