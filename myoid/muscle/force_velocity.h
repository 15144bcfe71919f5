#pragma once

namespace myoid::muscle {

/// Shape of one muscle's force-velocity relation. Every field must be positive.
template <typename T = double>
struct ForceVelocityShape {
  T max_shortening_speed_mps{};     ///< v_max [m/s]: speed of unloaded shortening.
  T concentric_curvature{};         ///< V_sh [-]: the smaller, the more bent the hyperbola.
  T eccentric_curvature_product{};  ///< P = V_sh V_shl [-]: only the product acts, so the product
                                    ///< is the parameter.
  T eccentric_plateau{};            ///< V_ml [-]: f_v in fast lengthening; above 1 in life.
};

/// Force-velocity multiplier f_v [-]: force over isometric force at the same length and activation.
/// `fiber_velocity_mps` is v = dl_m/dt [m/s], positive when the muscle lengthens.
///
///   f_v(v) = 0                                          v <= -v_max
///   f_v(v) = V_sh (v_max + v) / (V_sh v_max - v)   -v_max < v <= 0
///   f_v(v) = (P v_max + V_ml v) / (P v_max + v)         0 < v
///
/// Hence f_v(-v_max) = 0, f_v(0) = 1, f_v(inf) = V_ml; continuous, and never decreasing if V_ml
/// >= 1. The slopes at rest are (1 + 1/V_sh) / v_max and (V_ml - 1) / (P v_max); at v = 0 itself
/// derivatives are those of shortening. Below -v_max they all vanish: such samples say nothing
/// about the shape, so drop them before a fit. Each branch is used on its own side only, so that
/// the poles at v = V_sh v_max and v = -P v_max are never met. Equation (4) of the source paper.
template <typename T, typename V>
[[nodiscard]] T force_velocity(const V& fiber_velocity_mps, const ForceVelocityShape<T>& shape) {
  const V& v = fiber_velocity_mps;
  const T& v_max = shape.max_shortening_speed_mps;
  if (v <= -v_max) return T(0.0);
  if (v <= V(0.0))
    return shape.concentric_curvature * (v_max + v) / (shape.concentric_curvature * v_max - v);
  const T scale_mps = shape.eccentric_curvature_product * v_max;
  return (scale_mps + shape.eccentric_plateau * v) / (scale_mps + v);
}

/// P that makes the eccentric slope at rest `slope_ratio` times the concentric one:
///   P = (V_ml - 1) V_sh / (S (1 + V_sh)),   S = f_v'(0+) / f_v'(0-).
/// S = 1 joins the branches smoothly; S = 2 is Thelen (2003).
template <typename T>
[[nodiscard]] T curvature_product_from_slope_ratio(const T& slope_ratio,
                                                   const T& concentric_curvature,
                                                   const T& eccentric_plateau) {
  return (eccentric_plateau - T(1.0)) * concentric_curvature /
         (slope_ratio * (T(1.0) + concentric_curvature));
}

/// The inverse: S of a given P.
template <typename T>
[[nodiscard]] T slope_ratio(const ForceVelocityShape<T>& shape) {
  return (shape.eccentric_plateau - T(1.0)) * shape.concentric_curvature /
         (shape.eccentric_curvature_product * (T(1.0) + shape.concentric_curvature));
}

}  // namespace myoid::muscle
