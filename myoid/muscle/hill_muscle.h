#pragma once

#include "myoid/muscle/force_length.h"
#include "myoid/muscle/force_velocity.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::muscle {

/// Returns the fiber force [N], F_m = a f_l(l) f_v(v) F_max, equation (2) of the source paper. Activation in 0..1,
/// fiber length [m], velocity [m/s], positive in lengthening. No passive force, no pennation.
template <typename T>
[[nodiscard]] T hill_force(double activation,
                           double fiber_length_m,
                           double fiber_velocity_mps,
                           const HillParameters<T>& p) {
  const T v = T(fiber_velocity_mps) / p.max_shortening_speed_mps;
  return T(activation) * force_length(T(fiber_length_m), p.optimal_fiber_length_m, p.force_length_width_m) *
         force_velocity(p.velocity_law(), v).value * p.max_isometric_force_n;
}

}  // namespace myoid::muscle
