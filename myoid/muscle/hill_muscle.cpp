#include "myoid/muscle/hill_muscle.h"

namespace myoid::muscle {

HillForce hill_force_derivatives(double activation,
                                 double fiber_length_m,
                                 double fiber_velocity_mps,
                                 const HillParameters<double>& p) {
  HillForce result;
  const double v = fiber_velocity_mps;
  const double vm = p.max_shortening_speed_mps;
  if (v <= -vm) return result;
  const double width = p.force_length_width_m;
  const double stretch = fiber_length_m - p.optimal_fiber_length_m;
  const double fl = force_length(fiber_length_m, p.optimal_fiber_length_m, width);
  const double fv = force_velocity(v, p.velocity_shape());
  const double isometric = activation * fl * p.max_isometric_force_n;

  result.force_n = isometric * fv;
  result.by_max_isometric_force = activation * fl * fv;
  result.by_activation = fl * fv * p.max_isometric_force_n;
  result.by_optimal_fiber_length = result.force_n * 2.0 * stretch / (width * width);
  result.by_fiber_length = -result.by_optimal_fiber_length;
  result.by_force_length_width = result.by_optimal_fiber_length * stretch / width;
  if (v <= 0.0) {
    const double vsh = p.concentric_curvature;
    const double pole = vsh * vm - v;
    result.by_concentric_curvature = isometric * -v * (vm + v) / (pole * pole);
    result.by_max_shortening_speed = isometric * -vsh * (1.0 + vsh) * v / (pole * pole);
    result.by_fiber_velocity = isometric * vsh * (1.0 + vsh) * vm / (pole * pole);
  } else {
    const double product = p.eccentric_curvature_product;
    const double above = 1.0 - p.eccentric_plateau;
    const double pole = product * vm + v;
    result.by_eccentric_curvature_product = isometric * vm * v * above / (pole * pole);
    result.by_eccentric_plateau = isometric * v / pole;
    result.by_max_shortening_speed = isometric * product * v * above / (pole * pole);
    result.by_fiber_velocity = isometric * -product * vm * above / (pole * pole);
  }
  return result;
}

}  // namespace myoid::muscle
