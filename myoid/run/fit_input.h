#pragma once

#include <vector>

#include "myoid/core/progress.h"
#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/methods/resting_torque.h"
#include "myoid/model/body_model.h"
#include "myoid/phases/phases.h"
#include "myoid/run/trial_result.h"
#include "myoid/study/study.h"

namespace myoid {

/// The data and the options that a fit begins with.
struct FitInput {
  identification::StudyData data;  ///< Without the phases that the study excludes.
  identification::EstimatorOptions options;
  std::vector<TrialPhases> phases;  ///< Of the trials of `data`; empty: not searched.
};

/// What the data of a fit are made from; nothing is owned.
struct FitSource {
  const Study& study;  ///< With the uses of the trials.
  const model::BodyModel& model;
  const std::vector<TrialResult>& trials;
  const std::vector<identification::RestingJoint>& resting;
  std::vector<const TimeSeries*> activation;  ///< Of each trial; empty series: no EMG.
  const EmgScale& scale;                      ///< Of these activations.
};

/// The source that a run's own trials are.
[[nodiscard]] FitSource fit_source(const StudySource& source,
                                   const std::vector<TrialResult>& trials,
                                   const std::vector<identification::RestingJoint>& resting,
                                   const EmgScale& scale);

/// The data of the estimators, their options and the phases of the trials.
[[nodiscard]] FitInput fit_input(const FitSource& source, const Progress& progress);

}  // namespace myoid
