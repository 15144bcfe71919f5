#include <algorithm>
#include <cmath>
#include <limits>

#include "myoid/body/model/wrap_surfaces.h"

namespace myoid::body {
namespace {

/// Half the square of the distance from p + s (q - p) to the circle of radius R about z, without
/// terms independent of s, and its derivatives by s.
template <typename T>
struct Distance {
  T first, second;
};
template <typename T>
Distance<T> slope_at(const Vector3<T>& p, const Vector3<T>& d, double R, const T& s) {
  using std::sqrt;
  const T x = p.x() + s * d.x();
  const T y = p.y() + s * d.y();
  const T rho = sqrt(x * x + y * y);
  const T rho_first = (x * d.x() + y * d.y()) / rho;
  const T rho_second = (d.x() * d.x() + d.y() * d.y() - rho_first * rho_first) / rho;
  return {p.dot(d) + s * d.squaredNorm() - T(R) * rho_first, d.squaredNorm() - T(R) * rho_second};
}

/// Returns the place between p and q (0 .. 1) at which the straight piece is nearest to the circle,
/// on the side that counts.
std::optional<double> nearest_share(const Vec3& p, const Vec3& q, double R, Quadrant quadrant) {
  constexpr int kSamples = 64;
  const Vec3 d = q - p;
  const auto distance = [&](double s) {
    const Vec3 x = p + s * d;
    return std::hypot(x.head<2>().norm() - R, x.z());
  };
  const auto counts = [&](double s) {
    if (quadrant == 0) return true;
    const double c = (p + s * d)[std::abs(quadrant) - 1];
    return quadrant > 0 ? c >= 0.0 : c < 0.0;
  };
  double best = std::numeric_limits<double>::infinity();
  std::optional<double> share;
  for (int i = 0; i <= kSamples; ++i) {
    // A sample below its neighbors has a minimum nearby: Newton, held between them.
    const double step = 1.0 / kSamples;
    double s = step * i;
    const double here = distance(s);
    if ((i > 0 && distance(s - step) < here) || (i < kSamples && distance(s + step) <= here)) continue;
    const double low = std::max(0.0, s - step);
    const double high = std::min(1.0, s + step);
    for (int k = 0; k < 50; ++k) {
      const Distance<double> slope = slope_at<double>(p, d, R, s);
      const double next = slope.second > 0.0 ? std::clamp(s - slope.first / slope.second, low, high)
                                             : (slope.first > 0.0 ? 0.5 * (s + low) : 0.5 * (s + high));
      const bool settled = std::abs(next - s) < 1e-15;
      s = next;
      if (settled) break;
    }
    if (counts(s) && distance(s) < best) {
      best = distance(s);
      share = s;
    }
  }
  return share;
}

/// Returns the cylinder that replaces the tube where the straight piece is nearest to the ring's
/// circle; its x axis points to the middle of the ring.
template <typename T>
struct Tube {
  Vector3<T> center, ex, ey, ez;

  [[nodiscard]] Vector3<T> into(const Vector3<T>& v) const {
    const Vector3<T> r = v - center;
    return {r.dot(ex), r.dot(ey), r.dot(ez)};
  }
  [[nodiscard]] Vector3<T> back(const Vector3<T>& v) const { return center + v[0] * ex + v[1] * ey + v[2] * ez; }
};

template <typename T>
std::optional<Tube<T>> tube_at(double R, Quadrant quadrant, const Vector3<T>& p_W, const Vector3<T>& q_W) {
  using std::sqrt;
  const std::optional<double> share = nearest_share(value_of(p_W), value_of(q_W), R, quadrant);
  if (!share) return std::nullopt;
  const Vector3<T> d = q_W - p_W;
  T s(*share);
  if (*share > 0.0 && *share < 1.0) {
    // One more Newton step in T carries the derivatives of the nearest point.
    const Distance<T> slope = slope_at(p_W, d, R, s);
    s = s - slope.first / T(value_of(slope.second));
  }
  const T x = p_W.x() + s * d.x();
  const T y = p_W.y() + s * d.y();
  const T rho = sqrt(x * x + y * y);
  if (!(rho > T(1e-12))) return std::nullopt;
  Tube<T> tube;
  tube.center = {T(R) * x / rho, T(R) * y / rho, T(0.0)};
  tube.ex = {-x / rho, -y / rho, T(0.0)};
  tube.ey = {T(0.0), T(0.0), T(-1.0)};
  tube.ez = tube.ex.cross(tube.ey);
  return tube;
}

}  // namespace

std::optional<Pose> torus_tube(const TorusShape& torus, Quadrant quadrant, const Vec3& p_W, const Vec3& q_W) {
  const auto tube = tube_at<double>(torus.outer_radius_m, quadrant, p_W, q_W);
  if (!tube) return std::nullopt;
  Pose X_WC;
  X_WC.R << tube->ex, tube->ey, tube->ez;
  X_WC.p = tube->center;
  return X_WC;
}

template <typename T>
std::optional<ContactOf<T>> wrap_torus(const TorusShape& torus,
                                       Quadrant quadrant,
                                       const Vector3<T>& p_W,
                                       const Vector3<T>& q_W) {
  const auto tube = tube_at<T>(torus.outer_radius_m, quadrant, p_W, q_W);
  if (!tube) return std::nullopt;
  const CylinderShape cylinder{torus.inner_radius_m, 1e4};
  auto contact = wrap_cylinder<T>(cylinder, 1, tube->into(p_W), tube->into(q_W));
  if (!contact) return std::nullopt;
  contact->first_W = tube->back(contact->first_W);
  contact->second_W = tube->back(contact->second_W);
  return contact;
}

template std::optional<WrapContact> wrap_torus(const TorusShape&, Quadrant, const Vec3&, const Vec3&);
template std::optional<ContactOf<Jet6>> wrap_torus(const TorusShape&,
                                                   Quadrant,
                                                   const Vector3<Jet6>&,
                                                   const Vector3<Jet6>&);

}  // namespace myoid::body
