#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "myoid/body/model/wrap_surfaces.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

/// The nearest point of the surface, x_i = a_i^2 p_i / (t + a_i^2), where t is the largest root of
///   g(t) = sum (a_i p_i / (t + a_i^2))^2 - 1.
struct Nearest {
  bool is_center = false;  ///< p is the center: the end of the shortest axis instead.
  Eigen::Index shortest = 0;
  std::array<bool, 3> used{};
  double t = 0.0;
  double slope = 0.0;  ///< dg/dt
};

Nearest nearest_on(const Vec3& radii, const Vec3& p, int plane) {
  // g falls and is convex right of its poles: Newton from a point left of the root converges from the left.
  constexpr double kOnPlane = 1e-13;
  Nearest n;
  double shortest = std::numeric_limits<double>::infinity();
  double lowest = -std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const bool is_used = i != plane && std::abs(p[i]) > kOnPlane * radii[i];
    n.used[static_cast<std::size_t>(i)] = is_used;
    if (i != plane && radii[i] < shortest) {
      shortest = radii[i];
      n.shortest = i;
    }
    if (is_used) lowest = std::max(lowest, radii[i] * (std::abs(p[i]) - radii[i]));
  }
  n.is_center = !(n.used[0] || n.used[1] || n.used[2]);
  if (n.is_center) return n;
  n.t = lowest;
  for (int iteration = 0; iteration < 100; ++iteration) {
    double g = -1.0;
    n.slope = 0.0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (!n.used[static_cast<std::size_t>(i)]) continue;
      const double part = radii[i] * p[i] / (n.t + radii[i] * radii[i]);
      g += part * part;
      n.slope -= 2.0 * part * part / (n.t + radii[i] * radii[i]);
    }
    const double step = -g / n.slope;
    n.t += step;
    if (std::abs(step) <= 1e-15 * (std::abs(n.t) + shortest * shortest)) break;
  }
  return n;
}

template <typename T>
Vector3<T> closest_point(const Vec3& radii, const Vector3<T>& p, int plane = -1) {
  const Nearest n = nearest_on(radii, value_of(p), plane);
  Vector3<T> x(T(0.0), T(0.0), T(0.0));
  if (n.is_center) {
    x[n.shortest] = T(radii[n.shortest]);
    return x;
  }
  // One more Newton step in T carries the derivatives of the root.
  T g(-1.0);
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (!n.used[static_cast<std::size_t>(i)]) continue;
    const T part = p[i] * T(radii[i] / (n.t + radii[i] * radii[i]));
    g += part * part;
  }
  const T t = T(n.t) - g / T(n.slope);
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (n.used[static_cast<std::size_t>(i)]) x[i] = T(radii[i] * radii[i]) * p[i] / (t + T(radii[i] * radii[i]));
  }
  return x;
}

template <typename T>
Vector3<T> divided(const Vector3<T>& v, const Vec3& by) {
  return {v[0] / T(by[0]), v[1] / T(by[1]), v[2] / T(by[2])};
}
template <typename T>
Vector3<T> times(const Vector3<T>& v, const Vec3& by) {
  return {v[0] * T(by[0]), v[1] * T(by[1]), v[2] * T(by[2])};
}

/// Returns the part of the straight line inside the ellipsoid.
template <typename T>
struct Chord {
  Vector3<T> begin, end;
  [[nodiscard]] Vector3<T> at(const T& t) const { return begin + t * (end - begin); }
};

template <typename T>
std::optional<Chord<T>> chord_inside(const Vec3& radii, const Vector3<T>& p, const Vector3<T>& q) {
  using std::sqrt;
  // In coordinates where the ellipsoid is the unit sphere, |p + t (q - p)| = 1.
  const Vector3<T> P = divided(p, radii);
  const Vector3<T> d = divided(Vector3<T>(q - p), radii);
  constexpr double kInside = -1e-4;  // OpenSim's limit: ends may touch the surface
  if (P.squaredNorm() - T(1.0) < T(kInside) || (P + d).squaredNorm() - T(1.0) < T(kInside)) return std::nullopt;
  if (std::abs(value_of(p).normalized().dot(value_of(q).normalized()) - 1.0) < 1e-4) return std::nullopt;
  const T a = d.squaredNorm();
  const T b = P.dot(d);
  const T discriminant = b * b - a * (P.squaredNorm() - T(1.0));
  if (!(discriminant > T(0.0))) return std::nullopt;
  const T enter = (-b - sqrt(discriminant)) / a;
  const T leave = (-b + sqrt(discriminant)) / a;
  if (!(enter > T(0.0) && leave < T(1.0))) return std::nullopt;
  return Chord<T>{p + enter * (q - p), p + leave * (q - p)};
}

/// Returns the surface point nearest to the chord's middle, moved out by the mean radius in the
/// mean direction from the chord to the surface.
template <typename T>
Vector3<T> fan_point(const Vec3& radii, const Chord<T>& chord) {
  constexpr int kBlades = 300;
  Vector3<T> direction(T(0.0), T(0.0), T(0.0));
  for (int i = 1; i < kBlades - 1; ++i) {
    const Vector3<T> s = chord.at(T(static_cast<double>(i) / kBlades));
    direction += Vector3<T>(closest_point(radii, s) - s).normalized();
  }
  const Vector3<T> out = chord.at(T(0.5)) + T(radii.mean()) * direction.normalized();
  return closest_point(radii, out);
}

/// Returns the point c of the surface through which the wrapping plane goes.
template <typename T>
Vector3<T> plane_point(
    const Vec3& radii, Quadrant quadrant, WrapMethod method, const Vector3<T>& along, const Chord<T>& chord) {
  T fan_weight(0.0);
  Vector3<T> c(T(0.0), T(0.0), T(0.0));
  if (method == WrapMethod::midpoint) {
    c = closest_point(radii, chord.at(T(0.5)));
  } else {
    int axis = 0;
    value_of(along).cwiseAbs().maxCoeff(&axis);
    T parallel = along[axis] / along.norm();
    if (parallel < T(0.0)) parallel = -parallel;
    const T t = -chord.begin[axis] / (chord.end[axis] - chord.begin[axis]);
    if (method == WrapMethod::hybrid) {
      // The crossing must be well within the chord; towards its ends the axial point fades out.
      if (parallel > T(kBlendMin)) {
        const T to_end = t < T(1.0) - t ? t : T(1.0) - t;
        const T inside = std::clamp(T(to_end / T(kBoundary)), T(0.0), T(1.0));
        parallel = T(kBlendMin) + inside * (parallel - T(kBlendMin));
      }
      fan_weight = std::clamp(T((T(kBlendMax) - parallel) / T(kBlendMax - kBlendMin)), T(0.0), T(1.0));
    }
    if (fan_weight < T(1.0)) c = closest_point(radii, chord.at(t), axis);
    if (value_of(fan_weight) == 1.0) {
      c = fan_point(radii, chord);
    } else if (fan_weight > T(0.0)) {
      const Vector3<T> blend = (T(1.0) - fan_weight) * c + fan_weight * fan_point(radii, chord);
      c = closest_point(radii, blend);
    }
  }
  if (quadrant != 0) {
    const Eigen::Index axis = std::abs(quadrant) - 1;
    const double side = quadrant > 0 ? 1.0 : -1.0;
    if ((value_of(c[axis]) >= 0.0 ? 1.0 : -1.0) != side) {
      // Mirrored, then drawn back towards the plane of symmetry by the weight of the fan.
      c[axis] *= fan_weight - T(1.0);
      if (fan_weight > T(0.0)) c = closest_point(radii, c);
    }
  }
  return c;
}

}  // namespace

Vec3 closest_point_on_ellipsoid(const Vec3& radii_m, const Vec3& p, int plane) {
  return closest_point(radii_m, p, plane);
}

template <typename T>
std::optional<ContactOf<T>> wrap_ellipsoid(const EllipsoidShape& ellipsoid,
                                           Quadrant quadrant,
                                           WrapMethod method,
                                           const Vector3<T>& p_W,
                                           const Vector3<T>& q_W) {
  using std::acos;
  using std::atan2;
  using std::cos;
  using std::sin;
  using std::sqrt;
  const Vec3& radii = ellipsoid.radii_m;
  const std::optional<Chord<T>> chord = chord_inside(radii, p_W, q_W);
  if (!chord) return std::nullopt;
  const Vector3<T> c = plane_point(radii, quadrant, method, Vector3<T>(q_W - p_W), *chord);

  // A scaling makes the ellipsoid the unit sphere. Planes stay planes, tangents stay tangents, and the cut is a circle.
  const Vector3<T> P = divided(p_W, radii);
  const Vector3<T> Q = divided(q_W, radii);
  const Vector3<T> C = divided(c, radii);
  const Vector3<T> u = Vector3<T>(Q - P).normalized();
  Vector3<T> v = (C - P) - (C - P).dot(u) * u;
  if (!(v.norm() > T(1e-12))) return std::nullopt;  // c is on the line, which defines no plane
  v.normalize();                                    // towards c: the path bulges to +v and turns from v to u
  const Vector3<T> normal = u.cross(v);
  const Vector3<T> center = P.dot(normal) * normal;
  const T square = T(1.0) - center.squaredNorm();
  if (!(square > T(0.0))) return std::nullopt;
  const T radius = sqrt(square);
  const auto polar = [&](const Vector3<T>& X) { return T(atan2((X - center).dot(v), (X - center).dot(u))); };
  const auto to_tangent = [&](const Vector3<T>& X) {
    const T cosine = radius / (X - center).norm();
    return cosine < T(1.0) ? T(acos(cosine)) : T(0.0);
  };
  const T first = polar(P) - to_tangent(P);
  const T last = polar(Q) + to_tangent(Q);
  const T turned = within_one_turn(T(first - last));
  const auto on_cut = [&](const T& angle) {
    return times(Vector3<T>(center + radius * (cos(angle) * u + sin(angle) * v)), radii);
  };

  ContactOf<T> contact;
  contact.first_W = on_cut(first);
  contact.second_W = on_cut(last);
  // Length of the ellipse's arc: Gauss-Legendre of order 6 on pieces of at most pi/16; the integrand is smooth.
  constexpr std::array<double, 3> kNode{0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
  constexpr std::array<double, 3> kWeight{0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
  const int pieces = 1 + static_cast<int>(value_of(turned) * 16.0 / kPi);
  const T half = turned * T(0.5 / pieces);
  // |d/d angle| of the cut: (A cos^2 + B sin^2 + 2 D sin cos) of the scaled axes.
  const Vector3<T> su = times(u, radii);
  const Vector3<T> sv = times(v, radii);
  const T uu = su.squaredNorm();
  const T vv = sv.squaredNorm();
  const T uv = su.dot(sv);
  const auto speed = [&](const T& angle) {
    const T s = sin(angle);
    const T k = cos(angle);
    return T(radius * sqrt(uu * s * s + vv * k * k - T(2.0) * uv * s * k));
  };
  for (int i = 0; i < pieces; ++i) {
    const T middle = first - half * T(2.0 * i + 1.0);
    for (std::size_t k = 0; k < 3; ++k) {
      contact.arc_length_m +=
          half * T(kWeight[k]) * (speed(middle - half * T(kNode[k])) + speed(middle + half * T(kNode[k])));
    }
  }
  return contact;
}

template std::optional<WrapContact> wrap_ellipsoid(
    const EllipsoidShape&, Quadrant, WrapMethod, const Vec3&, const Vec3&);
template std::optional<ContactOf<Jet6>> wrap_ellipsoid(
    const EllipsoidShape&, Quadrant, WrapMethod, const Vector3<Jet6>&, const Vector3<Jet6>&);

}  // namespace myoid::body
