#pragma once

#include "myoid/ground/math/random.h"
#include "myoid/lab/virtual_person/protocol.h"
#include "myoid/lab/virtual_person/virtual_arm.h"

namespace myoid::lab {

// Standard deviations between persons, used in draw_muscles and draw_true_arm.
/// The two parts of the spread of ln F_max, which together are 0.25.
inline constexpr double kSharedStrengthSd = 0.2;  ///< The whole person's.
inline constexpr double kStrengthSd = 0.15;       ///< The muscle's own.
/// The relative spread of l_m^0. The estimator's belief is wider: it holds the error of the model.
inline constexpr double kFiberLengthSd = 0.10;

/// Draws the muscle parameters of a virtual person about `literature` with `spec.spread` times
/// these standard deviations: ln F_max 0.2 for the whole person and 0.15 per muscle, l_0 10 %, l_sh
/// 0.12 l_0, ln V_sh 0.3, ln v_max 0.2, V_ml 0.15, ln S 0.5 (slope of f_v in lengthening over the slope in shortening,
/// from which V_sh V_shl = (V_ml - 1) V_sh / (S (1 + V_sh))), l_ts 3 %. The mean is shifted by `spec.offset` standard
/// deviations (for ln F_max: 0.25). Parameters outside `spec.vary` stay at the literature, and `spec.values` sets
/// parameters directly. Draws without physical sense (l_sh < 0.2 l_0, V_ml < 1.05, or beyond the bounds of
/// muscle::kHillFields) are repeated.
[[nodiscard]] HillSet draw_muscles(const TruthSpec& spec, const HillSet& literature, math::Random& random);

/// The parameters of a person at L0 and L1 beside the muscles' parameters.
struct BesideMuscles {
  double length_activation = 0.0;  ///< gamma of l_0 (1 + gamma (1 - a)), for all muscles.
  /// The joint's own torque is torque_nm - stiffness q - viscosity qdot.
  double joint_torque_nm = 0.0, joint_stiffness_nm_per_rad = 0.0, joint_viscosity_nms_per_rad = 0.0;
  PerMuscle emg_exponent = {1.0, 1.0, 1.0, 1.0};
};

/// Draws from a fit's priors (fit/beliefs/beliefs.h), `spec.spread` times: gamma 0.1, torque 1 N m, stiffness 1 N
/// m/rad, viscosity 0.2 N m s/rad, ln of the exponents 0.2. Gamma and viscosity are absolute values of normal numbers,
/// because no fit lets them be negative. Without `spec.beside_muscles` all parameters have no effect.
[[nodiscard]] BesideMuscles draw_beside_muscles(const TruthSpec& spec, math::Random random);

}  // namespace myoid::lab
