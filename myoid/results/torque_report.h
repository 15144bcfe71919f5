#pragma once

#include <vector>

#include "myoid/report/report.h"
#include "myoid/run/study_result.h"

namespace myoid {

/// Returns the sections on predictions of trials outside the fit: left out in turn, with every baseline, and held back.
/// One row and one panel for each trial and joint; empty without such trials.
[[nodiscard]] std::vector<report::Section> validation_sections(const StudyResult& result);

/// Returns the section on the recordings: duration, held mass, range of every joint and of its torque.
[[nodiscard]] report::Table trials_table(const StudyResult& result);

}  // namespace myoid
