#pragma once

#include "myoid/simulation/protocol.h"
#include "myoid/simulation/random.h"
#include "myoid/simulation/virtual_arm.h"

namespace myoid::simulation {

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
                                   Random& random);

}  // namespace myoid::simulation
