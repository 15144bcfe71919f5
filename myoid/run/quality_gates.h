#pragma once

#include <string_view>
#include <vector>

#include "myoid/page/report.h"
#include "myoid/run/study_result.h"

namespace myoid::run {

/// Returns the gates that decide whether the run's numbers can be trusted: input, inverse
/// kinematics, force sharing, EMG, fit and prediction, each with the result, the expectation and
/// the reason. The list heads the report, is printed in the terminal, and decides exit code 4.
[[nodiscard]] std::vector<page::Gate> quality_gates(const StudyResult& result);

/// Returns true if a gate of the motion failed (inverse kinematics, markers, angles): a parameter
/// is at most as good as the motion it is computed from.
[[nodiscard]] bool motion_is_unreliable(const study::Study& study, const std::vector<TrialResult>& trials);

inline constexpr std::string_view kSharingGate = "Force sharing certified optimal";

}  // namespace myoid::run
