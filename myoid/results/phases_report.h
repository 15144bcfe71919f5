#pragma once

#include "myoid/report/report.h"
#include "myoid/run/study_result.h"

namespace myoid {

/// Returns the section on warm-up, fatigue and rest: a table of all phases but whole regular
/// trials, and the torque of each trial with an excluded phase.
[[nodiscard]] report::Section phases_section(const StudyResult& result);

/// Returns the section on forces and activations with the identified muscles, informed by the EMG,
/// and on the end of the loop of forces and parameters.
[[nodiscard]] report::Section informed_section(const StudyResult& result);

}  // namespace myoid
