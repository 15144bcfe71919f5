#pragma once

#include <vector>

#include "myoid/fit/measurement/options.h"
#include "myoid/run/fit_input.h"
#include "myoid/study/phases/phases.h"

namespace myoid::run {

/// Finds the phases of every trial that is fitted or predicted: `find_phases` on the torque that a first, plain fit of
/// all trials predicts from the EMG, and on the median frequency of the raw EMG where there is one. Trials that are too
/// short to search get one phase; if all are, no fit is made. A trial whose joint's angle is unknown has no phases; if
/// all are so, the result is empty.
[[nodiscard]] std::vector<study::TrialPhases> study_phases(const FitSource& source,
                                                           const fit::StudyData& data,
                                                           fit::EstimatorOptions options);

/// Marks the phases of the kinds that `rule` names and takes their time out of the data. A phase of
/// fatigue that only the torque shows (no raw EMG) stays, because the law may be wrong instead.
void exclude_phases(const std::vector<study::PhaseKind>& rule,
                    std::vector<study::TrialPhases>& phases,
                    fit::StudyData& data);

}  // namespace myoid::run
