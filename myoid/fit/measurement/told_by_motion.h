#pragma once

#include <optional>

#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// Number of coefficients of a torque that motion alone tells: c_0 to c_3 (told_by_motion_alone).
inline constexpr int kMotionCoefficients = 4;

/// Returns the share of the torque's variance that a spring, a damper and an inertia explain,
///
///   y = c_0 + c_1 q + c_2 dq/dt + c_3 d2q/dt2   [N m; q in rad],
///
/// by least squares over the calibration trials, of the joint where it is least. Muscles that work against each other
/// can make such a torque with hardly any EMG, and no fit can tell them from muscles that do not. Empty: the data have
/// no motion of a joint, or a trial holds a joint within 5 degrees, whose torque is then an effort and not a movement.
[[nodiscard]] std::optional<double> told_by_motion_alone(const StudyData& data);

}  // namespace myoid::fit
