#pragma once

#include "myoid/muscle/force_length.h"
#include "myoid/muscle/force_velocity.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::muscle {

/// Fiber force [N]:  F_m = a f_l(l) f_v(v) F_max. Activation in 0..1, fiber length [m], velocity
/// [m/s], positive when lengthening. No passive force, no pennation. Equation (2) of the source
/// paper.
template <typename T>
[[nodiscard]] T hill_force(double activation,
                           double fiber_length_m,
                           double fiber_velocity_mps,
                           const HillParameters<T>& p) {
  return T(activation) *
         force_length(T(fiber_length_m), p.optimal_fiber_length_m, p.force_length_width_m) *
         force_velocity(T(fiber_velocity_mps), p.velocity_shape()) * p.max_isometric_force_n;
}

/// The force and its partial derivatives, in closed form.
struct HillForce {
  double force_n = 0.0;
  double by_max_isometric_force = 0.0;          ///< dF/dF_max
  double by_optimal_fiber_length = 0.0;         ///< dF/dl0 [N/m]
  double by_force_length_width = 0.0;           ///< dF/dl_sh [N/m]
  double by_concentric_curvature = 0.0;         ///< dF/dV_sh [N]; 0 in lengthening
  double by_eccentric_curvature_product = 0.0;  ///< dF/dP [N]; 0 in shortening
  double by_eccentric_plateau = 0.0;            ///< dF/dV_ml [N]; 0 in shortening
  double by_max_shortening_speed = 0.0;         ///< dF/dv_max [N s/m]
  double by_activation = 0.0;                   ///< dF/da [N]
  double by_fiber_length = 0.0;                 ///< dF/dl [N/m]
  double by_fiber_velocity = 0.0;               ///< dF/dv [N s/m]
};

/// As `hill_force`, with all derivatives. At v = 0 those of shortening; below -v_max all are 0.
[[nodiscard]] HillForce hill_force_derivatives(double activation,
                                               double fiber_length_m,
                                               double fiber_velocity_mps,
                                               const HillParameters<double>& p);

}  // namespace myoid::muscle
