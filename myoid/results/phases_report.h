#pragma once

#include "myoid/page/report.h"
#include "myoid/run/study_result.h"

namespace myoid::results {

/// Returns the section on fatigue and rest: a table of all phases but whole regular
/// trials, and the torque of each trial with an excluded phase.
[[nodiscard]] page::Section phases_section(const run::StudyResult& result);

/// Returns the section on forces and activations with the identified muscles, informed by the EMG,
/// and on the end of the loop of forces and parameters.
[[nodiscard]] page::Section informed_section(const run::StudyResult& result);

}  // namespace myoid::results
