#pragma once

#include <vector>

#include "myoid/study/phases/phases.h"

namespace myoid::study {

/// Divides a trial into phases that cover it, in order.
///
/// - Rest and isometric phases: the joint stands still.
/// - Movement: each block of whole cycles (movement_blocks.h) has a ratio of measured to predicted torque and a median
///   frequency of the EMG. The times at which their means change follow from both together
///   (ground/math/change_points.h, Bayesian information criterion).
/// - `regular` is the longest segment between changes, or an earlier and fresher one.
/// - `fatigued` is a later segment with less torque per EMG and, where the frequency is known, a lower median
///   frequency. It begins where `kGainChange` is lost.
/// - `warm_up` is an earlier segment with another torque per EMG, or a beginning in which the muscles' effort for the
///   same torque differs and approaches the later level (warm_up.h).
/// - A held contraction is searched for fatigue in the same way, in windows.
///
/// With fewer than 8 blocks all movement is regular. Throws InvalidInput unless sizes agree and values are finite.
[[nodiscard]] std::vector<Phase> find_phases(const PhaseSignals& signals);

}  // namespace myoid::study
