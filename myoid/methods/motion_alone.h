#pragma once

#include <optional>
#include <string>

#include "myoid/identification/study_data.h"

namespace myoid::identification {

/// Returns the share of the torque's variance that a spring, a damper and an inertia explain,
///
///   y = c_0 + c_1 q + c_2 dq/dt + c_3 d2q/dt2   [N m; q in rad],
///
/// by least squares over the calibration trials, of the joint where it is least. Empty: a joint has
/// no motion in the data. Muscles that work against each other can make such a torque with hardly
/// any EMG, and no fit can tell them from muscles that do not.
[[nodiscard]] std::optional<double> told_by_motion_alone(const StudyData& data);

/// Returns the warning where that share is above 98 %, else nothing. No number of a muscle is then
/// called identified.
[[nodiscard]] std::optional<std::string> motion_alone_warning(const StudyData& data);

}  // namespace myoid::identification
