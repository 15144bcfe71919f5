#pragma once

#include "myoid/simulation/random.h"
#include "myoid/virtual_person/protocol.h"
#include "myoid/virtual_person/virtual_arm.h"

namespace myoid::twin {

// Standard deviations between persons, of draw_muscles and draw_true_arm.
/// The belief about ln F_max in two parts, which together make its standard deviation.
inline constexpr double kSharedStrengthSd = 0.2;  ///< The whole person's.
inline constexpr double kStrengthSd = 0.15;       ///< The muscle's own.

/// Muscle parameters of a virtual person, drawn about `literature` with `spec.spread` times these
/// standard deviations: ln F_max 0.2 for the whole person and 0.15 per muscle, l_0 10 %, l_sh
/// 0.12 l_0, ln V_sh 0.3, ln v_max 0.2, V_ml 0.15, ln S 0.5 (slope of f_v in lengthening over that
/// in shortening, whence V_sh V_shl = (V_ml - 1) V_sh / (S (1 + V_sh))), l_ts 3 %. The mean is
/// shifted by `spec.offset` standard deviations (of ln F_max: 0.25). What `spec.vary` does not name
/// stays at the literature; what `spec.values` gives is taken from there. Draws without physical
/// sense (l_sh < 0.2 l_0, V_ml < 1.05, or beyond the bounds of muscle::kHillFields) are drawn
/// again.
[[nodiscard]] HillSet draw_muscles(const TruthSpec& spec,
                                   const HillSet& literature,
                                   simulation::Random& random);

/// The parameters of a person at L0 and L1 that the fitted model has beside those of the muscles.
struct BesideMuscles {
  double length_activation = 0.0;  ///< gamma of l_0 (1 + gamma (1 - a)), of all muscles.
  /// The joint's own torque is torque_nm - stiffness q - viscosity qdot.
  double joint_torque_nm = 0.0, joint_stiffness_nm_per_rad = 0.0, joint_viscosity_nms_per_rad = 0.0;
  PerMuscle emg_exponent = {1.0, 1.0, 1.0, 1.0};
};

/// As a fit expects it beforehand (beliefs/beliefs.h), `spec.spread` times: gamma 0.1,
/// torque 1 N m, stiffness 1 N m/rad, viscosity 0.2 N m s/rad, ln of the exponents 0.2; gamma and
/// viscosity are sizes of normal numbers, since no fit lets them be negative. Nothing unless
/// `spec.beside_muscles`.
[[nodiscard]] BesideMuscles draw_beside_muscles(const TruthSpec& spec, simulation::Random random);

}  // namespace myoid::twin
