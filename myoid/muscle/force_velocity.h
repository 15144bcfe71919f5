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
  /// Below its zero the law is 0 (false), or its tangent there (true): negative, and invertible.
  bool tangent_below = false;
  T zero{1.0};               ///< z: the law is zero at -z.
  T lengthening_slope{0.0};  ///< kappa: the lengthening branch rises along a line of this slope.
};

/// Returns the force-velocity multiplier f_v [-], the force over the isometric force at equal length and activation,
/// and its slope d f_v / dv. `v` is dl_m/dt over v_max, positive in lengthening.
///
///   f_v(v) = 0                                     v <= -z
///   f_v(v) = V_sh (1 + v / z) / (V_sh - v)         -z < v <= 0
///   f_v(v) = (P + V_ml v) / (P + v) + kappa v      0 < v
///
/// The paper's law has z = 1 and kappa = 0. Hence f_v(-z) = 0, f_v(0) = 1, and without kappa f_v(inf) = V_ml. The law
/// is continuous and, if V_ml >= 1, never falls. The slopes at rest are 1/z + 1/V_sh and (V_ml - 1) / P + kappa; at v =
/// 0 derivatives are those of shortening. Without `tangent_below` a sample below -z says nothing about the shape: every
/// derivative is zero there, so a fit leaves it out.
template <typename T>
[[nodiscard]] CurvePoint<T> force_velocity(const VelocityHyperbola<T>& h, const T& v) {
  const double number = value_of(v);
  const T& c = h.concentric_curvature;
  if (number <= -value_of(h.zero)) {
    if (!h.tangent_below) return {T(0.0), 0.0};
    const T slope = c / (h.zero * (h.zero + c));
    return {slope * (h.zero + v), value_of(slope)};
  }
  if (number <= 0.0) {
    const T pole = c - v;
    return {c * (T(1.0) + v / h.zero) / pole, value_of(c * (T(1.0) + c / h.zero) / (pole * pole))};
  }
  const T& p = h.eccentric_curvature_product;
  const T& m = h.eccentric_plateau;
  if (value_of(h.tangent_from) < 1.0) {
    const T last = p * h.tangent_from / (T(1.0) - h.tangent_from);
    if (number > value_of(last)) {
      const T slope = p * (m - T(1.0)) / ((p + last) * (p + last));
      return {T(1.0) + (m - T(1.0)) * h.tangent_from + slope * (v - last) + h.lengthening_slope * v,
              value_of(slope + h.lengthening_slope)};
    }
  }
  const T pole = p + v;
  return {(p + m * v) / pole + h.lengthening_slope * v,
          value_of(p * (m - T(1.0)) / (pole * pole) + h.lengthening_slope)};
}

/// Returns the velocity [v_max] at which strength f_v(v) + damping v = force, all over F_max, in closed form: each
/// branch is a quadratic whose cancelling root is avoided. strength and damping are not negative, and not both zero.
/// Zero damping needs an invertible law: tangents on both sides and V_ml > 1.
[[nodiscard]] inline double solve_velocity(const VelocityHyperbola<double>& h,
                                           double strength,
                                           double damping,
                                           double force) {
  const double c = h.concentric_curvature;
  const double z = h.zero;
  if (force <= strength) {  // shortening, or rest
    if (force <= -damping * z) {
      if (!h.tangent_below) return force / damping;
      const double slope = strength * c / (z * (z + c));
      return (force - slope * z) / (slope + damping);
    }
    const double b = (strength / z + damping) * c + force;
    const double product = c * (strength - force);
    const double root = std::sqrt(b * b + 4.0 * damping * product);
    if (b > 0.0) return -2.0 * product / (b + root);
    return (b - root) / (2.0 * damping);
  }
  const double p = h.eccentric_curvature_product;
  const double m = h.eccentric_plateau;
  damping += strength * h.lengthening_slope;
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
