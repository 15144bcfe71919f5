#pragma once

#include <cmath>

#include "myoid/muscle/scalar.h"

namespace myoid::muscle {

/// Two hyperbolas that meet at rest, over the velocity in units of v_max: the force-velocity law of
/// the source paper's equation (4), and Thelen's (2003).
template <typename T = double>
struct VelocityHyperbola {
  T concentric_curvature{};         ///< V_sh [-]
  T eccentric_curvature_product{};  ///< P [-]
  T eccentric_plateau{};            ///< V_ml [-]
  /// Share of the way from 1 to the plateau at which the lengthening branch goes on as its tangent;
  /// 1: never, the published branch to infinity.
  T tangent_from{1.0};
  /// Below -v_max: false, zero; true, the tangent there (negative), which makes the law invertible.
  bool tangent_below = false;
};

/// f_v and its slope d f_v / dv at the velocity `v` [v_max], lengthening positive:
///   V_sh (1 + v) / (V_sh - v) for -1 < v <= 0,  (P + V_ml v) / (P + v) for v > 0;
/// beyond v = -1 and beyond the share `tangent_from` of the plateau as the fields say. At v = 0 the
/// slope is that of shortening.
template <typename T>
[[nodiscard]] CurvePoint<T> velocity_multiplier(const VelocityHyperbola<T>& h, const T& v) {
  const double number = value_of(v);
  const T& c = h.concentric_curvature;
  if (number <= -1.0) {
    if (!h.tangent_below) return {T(0.0), 0.0};
    const T slope = c / (T(1.0) + c);
    return {slope * (T(1.0) + v), value_of(slope)};
  }
  if (number <= 0.0) {
    const T pole = c - v;
    return {c * (T(1.0) + v) / pole, value_of(c * (T(1.0) + c) / (pole * pole))};
  }
  const T& p = h.eccentric_curvature_product;
  const T& m = h.eccentric_plateau;
  if (value_of(h.tangent_from) < 1.0) {
    const T last = p * h.tangent_from / (T(1.0) - h.tangent_from);
    if (number > value_of(last)) {
      const T slope = p * (m - T(1.0)) / ((p + last) * (p + last));
      return {T(1.0) + (m - T(1.0)) * h.tangent_from + slope * (v - last), value_of(slope)};
    }
  }
  const T pole = p + v;
  return {(p + m * v) / pole, value_of(p * (m - T(1.0)) / (pole * pole))};
}

/// The velocity [v_max] at which  strength f_v(v) + damping v = force,  in closed form: each branch
/// is a quadratic whose cancelling root is avoided. All in units of F_max; strength >= 0, damping
/// >= 0, not both zero. With zero damping the law must be invertible (tangents on both sides, V_ml
/// > 1).
[[nodiscard]] inline double solve_velocity(const VelocityHyperbola<double>& h,
                                           double strength,
                                           double damping,
                                           double force) {
  const double c = h.concentric_curvature;
  if (force <= strength) {  // shortening, or rest
    if (force <= -damping) {
      if (!h.tangent_below) return force / damping;
      const double slope = strength * c / (1.0 + c);
      return (force - slope) / (slope + damping);
    }
    const double b = (strength + damping) * c + force;
    const double product = c * (strength - force);
    const double root = std::sqrt(b * b + 4.0 * damping * product);
    if (b > 0.0) return -2.0 * product / (b + root);
    return (b - root) / (2.0 * damping);
  }
  const double p = h.eccentric_curvature_product;
  const double m = h.eccentric_plateau;
  if (h.tangent_from < 1.0) {
    const double last = p * h.tangent_from / (1.0 - h.tangent_from);
    const double value = 1.0 + (m - 1.0) * h.tangent_from;
    if (force > strength * value + damping * last) {
      const double slope = strength * p * (m - 1.0) / ((p + last) * (p + last)) + damping;
      return last + (force - strength * value - damping * last) / slope;
    }
  }
  const double b = strength * m + damping * p - force;
  const double product = p * (force - strength);
  const double root = std::sqrt(b * b + 4.0 * damping * product);
  if (b > 0.0) return 2.0 * product / (b + root);
  return (root - b) / (2.0 * damping);
}

}  // namespace myoid::muscle
