#pragma once

#include <vector>

#include "myoid/study/phases/phases.h"

namespace myoid::study {

/// Divides a trial into phases that cover it, in order.
///
/// - Rest and isometric phases: the joint stands still.
/// - Movement: each block of whole cycles (movement_blocks.h) has a ratio of measured to predicted torque and a median
///   frequency of the EMG. `fatigued` is the end in which both have fallen (fatigue_trend.h), the rest is `regular`.
/// - A held contraction is searched for fatigue in the same way, in windows.
///
/// With fewer than 8 blocks all movement is regular. Throws InvalidInput unless sizes agree and values are finite.
[[nodiscard]] std::vector<Phase> find_phases(const PhaseSignals& signals);

}  // namespace myoid::study
