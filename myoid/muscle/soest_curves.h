#pragma once

#include <cmath>

#include "myoid/muscle/force_velocity.h"
#include "myoid/muscle/scalar.h"

namespace myoid::muscle {

/// The curves of van Soest & Bobbert (1993), Biol Cybern 69:195-204, as Kistemaker, van Soest & Bobbert (2006), J
/// Neurophysiol 95:2898-2912, continued them. Lengths in optimal fiber lengths, velocities in v_max, forces in F_max.

/// The least active state: a muscle at rest shortens and lengthens without one, but not at once.
inline constexpr double kSoestRest = 0.005;

/// Returns the active force over the length: a parabola of half width w, with exponential tails below 0.1.
///
///   f_l(l) = 1 - x^2,  x = |l - 1| / w,  and 0.1 exp(-20 sqrt(0.9) (x - sqrt(0.9))) beyond x = sqrt(0.9)
template <typename T>
[[nodiscard]] CurvePoint<T> soest_force_length(const T& l, const T& width) {
  using std::exp;
  constexpr double kTail = 0.1;
  static const double join = std::sqrt(1.0 - kTail);
  const T x = (l - T(1.0)) / width;
  const double side = value_of(x) < 0.0 ? -1.0 : 1.0;
  if (std::abs(value_of(x)) <= join) return {T(1.0) - x * x, value_of(T(-2.0) * x / width)};
  const double rate = 2.0 * join / kTail;
  const T tail = T(kTail) * exp(T(-rate) * (T(side) * x - T(join)));
  return {tail, value_of(T(-rate * side) * tail / width)};
}

/// Returns the force-velocity hyperbolas at an activation q, a length l and its multiplier f_l. Hill's a falls with f_l
/// above the optimal length and is a constant below, where the greatest speed falls with f_l; Hill's b falls with q:
///
///   (F + q a') (v - b') = -b' (q f_l F_max + q a'),  a = V_sh F_max,  b = V_sh v_max,
///   a' = a f_l if l > 1, else a,   b' = b / (1 + exp(-22 (q - q_b))),  q_b = 0.005 + ln(9) / 22
///
/// The lengthening branch begins twice as steep as the shortening one and approaches V_ml along a line of the slope
/// 0.00975 (1 + V_sh) / V_sh [F_max per v_max].
template <typename T>
[[nodiscard]] VelocityHyperbola<T> soest_hyperbola(const T& concentric_curvature,
                                                   const T& eccentric_plateau,
                                                   const T& activation,
                                                   const T& l,
                                                   const T& length_multiplier) {
  using std::exp;
  constexpr double kSteepness = 22.0, kSlopeRatio = 2.0, kAsymptote = 0.00975;
  static const double half = kSoestRest + std::log(9.0) / kSteepness;
  const T& c = concentric_curvature;
  const T speed = T(1.0) / (T(1.0) + exp(T(-kSteepness) * (activation - T(half))));
  VelocityHyperbola<T> h;
  h.concentric_curvature = c * speed;
  h.eccentric_plateau = eccentric_plateau;
  h.zero = value_of(l) > 1.0 ? speed : length_multiplier * speed;
  const T slope = T(kSlopeRatio) * (T(1.0) / h.zero + T(1.0) / h.concentric_curvature);
  // The line is as steep at every activation: over the isometric force it grows where the force is small. Half of the
  // branch's own slope bounds it, at forces below a thousandth of F_max.
  h.lengthening_slope = T(kAsymptote) * (T(1.0) + c) / (c * activation * length_multiplier);
  if (!(value_of(h.lengthening_slope) < 0.5 * value_of(slope))) h.lengthening_slope = T(0.5) * slope;
  h.eccentric_curvature_product = (eccentric_plateau - T(1.0)) / (slope - h.lengthening_slope);
  return h;
}

/// Passive multiplier ((l - s) / (1 + e - s))^2 above the slack length s, else 0; 1 at the strain e.
template <typename T>
class SoestPassive {
 public:
  SoestPassive(const T& strain, const T& slack) : slack_(slack), reach_(T(1.0) + strain - slack) {}
  [[nodiscard]] CurvePoint<T> operator()(const T& l) const {
    if (value_of(l) <= value_of(slack_)) return {T(0.0), 0.0};
    const T x = (l - slack_) / reach_;
    return {x * x, value_of(T(2.0) * x / reach_)};
  }
  /// Returns the integral from the slack length: the energy over F_max l0.
  [[nodiscard]] T energy(const T& l) const {
    if (value_of(l) <= value_of(slack_)) return T(0.0);
    const T x = (l - slack_) / reach_;
    return x * x * x * reach_ / T(3.0);
  }

 private:
  T slack_, reach_;
};

/// Returns the tendon's multiplier (strain / e0)^2.
template <typename T>
[[nodiscard]] CurvePoint<T> soest_tendon(const T& strain, const T& strain_at_one) {
  const T x = strain / strain_at_one;
  return {x * x, value_of(T(2.0) * x / strain_at_one)};
}
/// Returns its integral: the energy over F_max l_t0.
template <typename T>
[[nodiscard]] T soest_tendon_energy(const T& strain, const T& strain_at_one) {
  const T x = strain / strain_at_one;
  return x * x * strain / T(3.0);
}

}  // namespace myoid::muscle
