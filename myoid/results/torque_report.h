#pragma once

#include <vector>

#include "myoid/page/report.h"
#include "myoid/run/study_result.h"

namespace myoid::results {

/// Returns the sections on predictions of trials outside the fit: left out in turn, with every baseline, and held back.
/// One row and one panel for each trial and joint; empty without such trials.
[[nodiscard]] std::vector<page::Section> validation_sections(const run::StudyResult& result);

/// Returns the section on the recordings: duration, held mass, range of every joint and of its torque.
[[nodiscard]] page::Table trials_table(const run::StudyResult& result);

}  // namespace myoid::results
