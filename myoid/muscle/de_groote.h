#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "myoid/muscle/scalar.h"

namespace myoid::muscle {

/// The curves of De Groote, Kinney, Rao & Fregly (2016), Ann Biomed Eng 44:2922-2936, infinitely smooth, with the
/// constants of OpenSim's muscle of this name (full precision, so that the curves pass through (1, 1), (-1, 0), (0,
/// 1)). Lengths in optimal fiber lengths or tendon slack lengths, velocities in v_max, forces in F_max.

/// Returns the active force-length multiplier: three bells b1 exp(-(l - b2)^2 / (2 (b3 + b4 l)^2)).
template <typename T>
[[nodiscard]] CurvePoint<T> de_groote_force_length(const T& l) {
  using std::exp;
  constexpr std::array<std::array<double, 4>, 3> b{
      {{0.8150671134243542, 1.055033428970575, 0.162384573599574, 0.063303448465465},
       {0.433004984392647, 0.716775413397760, -0.029947116970696, 0.200356847296188},
       {0.1, 1.0, 0.353553390593274, 0.0}}};
  CurvePoint<T> point{T(0.0), 0.0};
  for (const auto& k : b) {
    const T width = T(k[2]) + T(k[3]) * l;
    const T z = (l - T(k[1])) / width;
    const T bell = T(k[0]) * exp(T(-0.5) * z * z);
    point.value = point.value + bell;
    const double w = value_of(width);
    point.slope -= value_of(bell) * value_of(z) * (1.0 - value_of(z) * k[3]) / w;
  }
  return point;
}

inline constexpr std::array<double, 4> kDeGrooteVelocity{-0.3211346127989808, -8.149, -0.374, 0.8825327733249912};

/// Returns the force-velocity multiplier d1 asinh(d2 v + d3) + d4; 0 at v = -1 and *negative
/// below*, 1 at rest, 1.794 at v = 1. It has no plateau.
template <typename T>
[[nodiscard]] CurvePoint<T> de_groote_force_velocity(const T& v) {
  using std::log;
  using std::sqrt;
  const auto& [d1, d2, d3, d4] = kDeGrooteVelocity;
  const T x = T(d2) * v + T(d3);
  const T root = sqrt(x * x + T(1.0));
  // log(x + root) loses digits for x < 0, where it is -log(root - x).
  const T asinh_x = value_of(x) < 0.0 ? -log(root - x) : log(root + x);
  return {T(d1) * asinh_x + T(d4), d1 * d2 / value_of(root)};
}

/// Returns the velocity at which strength f + damping v = force, all over F_max; strength > 0,
/// damping >= 0. In x = asinh(d2 v + d3) this is -a x - b sinh(x) = rest, odd and monotone: Newton
/// from beyond the root never leaves its side.
[[nodiscard]] inline double solve_de_groote_velocity(double strength, double damping, double force) {
  const auto& [d1, d2, d3, d4] = kDeGrooteVelocity;
  const double a = -strength * d1;
  const double b = -damping / d2;
  const double rest = strength * d4 - b * (-d3) - force;
  const double r = std::abs(rest);
  double x = r / a;
  if (b > 0.0) {
    x = std::min(x, std::asinh(r / b));
    for (int k = 0; k < 60; ++k) {
      const double e = std::exp(x);
      const double half = 0.5 * b * e;
      const double other = 0.5 * b / e;
      const double step = (a * x + half - other - r) / (a + half + other);
      x -= step;
      if (std::abs(step) <= 1e-16 * (1.0 + x)) break;
    }
  }
  return (std::sinh(rest < 0.0 ? -x : x) - d3) / d2;
}

/// Passive multiplier (exp(k (l - 1) / e) - o) / (exp(k) - o), o = exp(k (0.2 - 1) / e): 0 at l =
/// 0.2, 1 at l = 1 + e. Published: k = 4 (`shape`), e = 0.6 (`strain`).
template <typename T>
class DeGrootePassive {
 public:
  DeGrootePassive(const T& strain, const T& shape) : rate_(shape / strain) {
    using std::exp;
    offset_ = exp(T(-0.8) * rate_);
    scale_ = T(1.0) / (exp(shape) - offset_);
  }
  [[nodiscard]] CurvePoint<T> operator()(const T& l) const {
    using std::exp;
    const T e = exp(rate_ * (l - T(1.0)));
    return {(e - offset_) * scale_, value_of(e * scale_ * rate_)};
  }
  /// Returns the integral from l = 0.2: the energy over F_max l0.
  [[nodiscard]] T energy(const T& l) const {
    using std::exp;
    return ((exp(rate_ * (l - T(1.0))) - offset_) / rate_ - offset_ * (l - T(0.2))) * scale_;
  }

 private:
  T rate_, offset_, scale_;
};

/// Returns the tendon multiplier (exp(k e) - 1) / 5 with k = ln(6) / e0, over the strain e; 1 at e0 (published: 0.049).
/// The published curve continues below slack, to a push of F_max / 5; here it is 0 there.
template <typename T>
[[nodiscard]] CurvePoint<T> de_groote_tendon(const T& strain, const T& strain_at_max_force) {
  using std::exp;
  if (value_of(strain) <= 0.0) return {T(0.0), 0.0};
  const T rate = T(std::log(6.0)) / strain_at_max_force;
  const T e = exp(rate * strain);
  return {T(0.2) * (e - T(1.0)), value_of(T(0.2) * rate * e)};
}

/// Returns the integral of de_groote_tendon from slack, the energy over F_max l_t0.
template <typename T>
[[nodiscard]] T de_groote_tendon_energy(const T& strain, const T& strain_at_max_force) {
  using std::exp;
  if (value_of(strain) <= 0.0) return T(0.0);
  const T rate = T(std::log(6.0)) / strain_at_max_force;
  return T(0.2) * ((exp(rate * strain) - T(1.0)) / rate - strain);
}

}  // namespace myoid::muscle
