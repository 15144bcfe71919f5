#pragma once

#include "myoid/report/report.h"
#include "myoid/run/study_result.h"

namespace myoid {

/// What was found of warm-up, fatigue, standing still: a table of all phases that are not one whole
/// regular trial, and the torque of each trial with a phase that was left out.
[[nodiscard]] report::Section phases_section(const StudyResult& result);

/// Forces and activations with the identified muscles, informed by the EMG, and how the loop of
/// forces and parameters ended, if the study asked for it.
[[nodiscard]] report::Section informed_section(const StudyResult& result);

}  // namespace myoid
