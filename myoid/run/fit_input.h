#pragma once

#include <vector>

#include "myoid/core/progress.h"
#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/phases/phases.h"
#include "myoid/run/fit_source.h"

namespace myoid {

/// The data and the options of a fit.
struct FitInput {
  identification::StudyData data;  ///< Without the phases that the study excludes.
  identification::EstimatorOptions options;
  std::vector<TrialPhases> phases;  ///< Phases of the trials of `data`; empty: not searched.
};

/// Makes the data of the estimators, their options and the phases of the trials.
[[nodiscard]] FitInput fit_input(const FitSource& source, const Progress& progress);

}  // namespace myoid
