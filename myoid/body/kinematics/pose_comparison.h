#pragma once

#include "myoid/body/kinematics/pose_fit.h"

namespace myoid::body {

/// Returns true if pose a may stand in place of b, with a cost below `share` of the other's.
[[nodiscard]] bool replaces(const PoseFit::Pose& a, const PoseFit::Pose& b, double share);

/// Returns the difference of the costs in units of the lower one.
[[nodiscard]] double gain_of(const PoseFit::Pose& then, const PoseFit::Pose& now);

/// Returns true if the first pose fits better by more than poses that fit alike.
[[nodiscard]] bool clearly_better(const PoseFit::Pose& then, const PoseFit::Pose& now);

/// Returns true if two searches ended in one minimum.
[[nodiscard]] bool same_posture(const PoseFit::Pose& a, const PoseFit::Pose& b);

}  // namespace myoid::body
