#pragma once

#include <cmath>

#include "myoid/muscle/scalar.h"

namespace myoid::muscle {

/// Force-velocity relation of two hyperbolas that meet at rest, over v / v_max: equation (4) of the
/// source paper, and the law of Thelen (2003). The first three fields must be positive.
template <typename T = double>
struct VelocityHyperbola {
  T concentric_curvature{};         ///< V_sh [-]: the smaller, the more bent the hyperbola.
  T eccentric_curvature_product{};  ///< P = V_sh V_shl [-]: only the product acts.
  T eccentric_plateau{};            ///< V_ml [-]: f_v in fast lengthening; above 1 in life.
  /// Share of the way from 1 to the plateau at which the lengthening branch continues as its tangent.
  /// 1: the published branch goes on to infinity.
  T tangent_from{1.0};
  /// Below -v_max the law is zero (false), or its tangent there (true): negative, and invertible.
  bool tangent_below = false;
};

/// Returns the force-velocity multiplier f_v [-], the force over the isometric force at equal length and activation,
/// and its slope d f_v / dv. `v` is dl_m/dt over v_max, positive in lengthening.
///
///   f_v(v) = 0                            v <= -1
///   f_v(v) = V_sh (1 + v) / (V_sh - v)    -1 < v <= 0
///   f_v(v) = (P + V_ml v) / (P + v)       0 < v
///
/// Hence f_v(-1) = 0, f_v(0) = 1, f_v(inf) = V_ml. The law is continuous and, if V_ml >= 1, never falls. The slopes at
/// rest are 1 + 1/V_sh and (V_ml - 1) / P; at v = 0 derivatives are those of shortening. Without `tangent_below` a
/// sample below -1 says nothing about the shape: every derivative is zero there, so a fit leaves it out.
template <typename T>
[[nodiscard]] CurvePoint<T> force_velocity(const VelocityHyperbola<T>& h, const T& v) {
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

/// Returns the velocity [v_max] at which strength f_v(v) + damping v = force, all over F_max, in closed form: each
/// branch is a quadratic whose cancelling root is avoided. strength and damping are not negative, and not both zero.
/// Zero damping needs an invertible law: tangents on both sides and V_ml > 1.
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

/// Returns the P that makes the eccentric slope at rest `slope_ratio` times the concentric one:
///   P = (V_ml - 1) V_sh / (S (1 + V_sh)),   S = f_v'(0+) / f_v'(0-).
/// S = 1 joins the branches smoothly; S = 2 is Thelen (2003).
template <typename T>
[[nodiscard]] T curvature_product_from_slope_ratio(const T& slope_ratio,
                                                   const T& concentric_curvature,
                                                   const T& eccentric_plateau) {
  return (eccentric_plateau - T(1.0)) * concentric_curvature / (slope_ratio * (T(1.0) + concentric_curvature));
}

/// Returns S of a law, the inverse of curvature_product_from_slope_ratio.
template <typename T>
[[nodiscard]] T slope_ratio(const VelocityHyperbola<T>& h) {
  return (h.eccentric_plateau - T(1.0)) * h.concentric_curvature /
         (h.eccentric_curvature_product * (T(1.0) + h.concentric_curvature));
}

}  // namespace myoid::muscle
