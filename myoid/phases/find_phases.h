#pragma once

#include <vector>

#include "myoid/phases/phases.h"

namespace myoid {

/// Phases that cover the trial, in order. Rest and isometric phases are where the joint stands
/// still. In what remains, torque measured per torque predicted and the EMG's median frequency are
/// formed per block of whole cycles (movement_blocks.h), and both are searched together for the
/// times at which their means change (math/change_points.h, Bayesian information criterion, the
/// noise as it counts in means of several blocks). The longest segment is `regular`, or an earlier
/// one that was fresher; one behind it is fatigue if its torque per EMG is lower and, where it is
/// known, the median frequency as well; it begins where `gain_change` is lost. Warm-up is a segment
/// before the regular one whose torque per EMG differs, or a beginning in which the muscles' effort
/// for the same torque is another and fades (warm_up.h). A contraction that is held is searched for
/// fatigue in the same way, in windows. Nothing is searched with fewer than 8 blocks. Throws
/// InvalidInput unless sizes agree and values are finite.
[[nodiscard]] std::vector<Phase> find_phases(const PhaseSignals& signals,
                                             const PhaseOptions& options = {});

}  // namespace myoid
