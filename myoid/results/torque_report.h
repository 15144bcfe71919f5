#pragma once

#include <vector>

#include "myoid/report/report.h"
#include "myoid/run/study_result.h"

namespace myoid {

/// Joint torques predicted by the identified muscles for trials that took no part in the fit: those
/// left out in turn, with every baseline beside them, and those held back. One row and one panel
/// for each trial and joint; empty if there were none.
[[nodiscard]] std::vector<report::Section> validation_sections(const StudyResult& result);

/// The recordings: duration, held mass, range of every joint and of its torque.
[[nodiscard]] report::Table trials_table(const StudyResult& result);

}  // namespace myoid
