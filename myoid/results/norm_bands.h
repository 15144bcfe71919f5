#pragma once

#include "myoid/page/workbench.h"
#include "myoid/run/study_result.h"

namespace myoid::results {

/// Draws the study's norms behind the angles and torques of a trial: mean ± 1 standard deviation, 0 % at the begin of
/// its motion, 100 % at the end. A trial that is a part of a movement, cut at a pause of its clock, gets none.
void add_norms(const run::StudySource& source, const run::TrialResult& trial, page::WorkbenchTrial& shown);

}  // namespace myoid::results
