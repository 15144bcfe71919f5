#include "myoid/body/model/bent_rod.h"

#include <array>
#include <cmath>
#include <span>

#include "myoid/body/model/functions.h"

namespace myoid::body {
namespace {

/// Value and derivatives by c = cos(theta).
using Curve = FunctionValue;

/// Evaluates a power series with its derivatives: of tau = theta^2, or of e = 1 - c.
Curve series(std::span<const double> coefficients, double x) {
  const Eigen::Map<const Eigen::VectorXd> lowest_first(coefficients.data(), std::ssize(coefficients));
  return polynomial_value(lowest_first.reverse(), x);
}

struct Rod {
  Curve across;  ///< (1 - cos)/(theta sin) = tan(theta/2)/theta.
  Curve along;   ///< sin(theta)/theta.
};

/// Returns the derivatives by c of f(tau(e)), where e = 1 - c: the chain rule with de/dc = -1.
Curve chained(const Curve& outer, const Curve& tau) {
  return {outer.value, -outer.first * tau.first, outer.second * tau.first * tau.first + outer.first * tau.second};
}

/// Converts derivatives by theta to derivatives by c = cos(theta).
Curve by_cosine(double value, double by_theta, double by_theta2, double c, double s) {
  return {value, -by_theta / s, (by_theta2 * s - by_theta * c) / (s * s * s)};
}

Rod rod_at(double c, double s) {
  const double theta = std::atan2(s, c);
  if (theta < 0.1) {
    // arccos(1 - e)^2 = 2 sum (2e)^n / (n^2 C(2n, n))
    constexpr std::array<double, 7> kTau{0.0, 2.0, 1.0 / 3.0, 4.0 / 45.0, 1.0 / 35.0, 16.0 / 1575.0, 8.0 / 2079.0};
    constexpr std::array<double, 6> kAlong{1.0,           -1.0 / 6.0,     1.0 / 120.0,
                                           -1.0 / 5040.0, 1.0 / 362880.0, -1.0 / 39916800.0};
    constexpr std::array<double, 6> kAcross{
        0.5, 1.0 / 24.0, 1.0 / 240.0, 17.0 / 40320.0, 31.0 / 725760.0, 691.0 / 159667200.0};
    // 1 - c = 2 sin^2(theta/2) without cancellation.
    const double half = std::sin(0.5 * theta);
    const Curve tau = series(kTau, 2.0 * half * half);
    return {chained(series(kAcross, tau.value), tau), chained(series(kAlong, tau.value), tau)};
  }
  const double h = s / theta, h1 = (c - h) / theta, h2 = (-s - 2.0 * h1) / theta;
  const double t = std::tan(0.5 * theta), t1 = 0.5 * (1.0 + t * t), t2 = t * t1;
  const double g = t / theta, g1 = (t1 - g) / theta, g2 = (t2 - 2.0 * g1) / theta;
  return {by_cosine(g, g1, g2, c, s), by_cosine(h, h1, h2, c, s)};
}

Rod rod_along(const Vec3& u) { return rod_at(u.y(), std::hypot(u.x(), u.z())); }

Vec3 across_y(const Vec3& v) { return {v.x(), 0.0, v.z()}; }

}  // namespace

Vec3 bent_rod_end(double length_m, const Vec3& u) {
  const Rod rod = rod_along(u);
  return length_m * (rod.across.value * across_y(u) + rod.along.value * Vec3::UnitY());
}

Vec3 bent_rod_velocity(double length_m, const Vec3& u, const Vec3& du) {
  const Rod rod = rod_along(u);
  const double dc = du.y();
  return length_m *
         (rod.across.first * dc * across_y(u) + rod.across.value * across_y(du) + rod.along.first * dc * Vec3::UnitY());
}

Vec3 bent_rod_acceleration(double length_m, const Vec3& u, const Vec3& du, const Vec3& ddu) {
  const Rod rod = rod_along(u);
  const double dc = du.y(), ddc = ddu.y();
  const auto rate2 = [&](const Curve& f) { return f.second * dc * dc + f.first * ddc; };
  return length_m * (rate2(rod.across) * across_y(u) + 2.0 * rod.across.first * dc * across_y(du) +
                     rod.across.value * across_y(ddu) + rate2(rod.along) * Vec3::UnitY());
}

}  // namespace myoid::body
