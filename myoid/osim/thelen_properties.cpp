#include "myoid/osim/thelen_properties.h"

namespace myoid::model {

muscle::ThelenParameters thelen_parameters(const MuscleProperties& p) {
  return {.max_isometric_force_n = p.max_isometric_force_n,
          .optimal_fiber_length_m = p.optimal_fiber_length_m,
          .tendon_slack_length_m = p.tendon_slack_length_m,
          .pennation_at_optimal_rad = p.pennation_at_optimal_rad,
          .max_contraction_velocity = p.max_contraction_velocity,
          .active_shape = p.active_shape,
          .concentric_shape = p.concentric_shape,
          .eccentric_plateau = p.eccentric_plateau,
          .extrapolation = p.force_velocity_extrapolation,
          .max_pennation_rad = p.max_pennation_rad};
}

}  // namespace myoid::model
