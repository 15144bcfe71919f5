#pragma once

#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/intake/study_activation.h"
#include "myoid/methods/resting_torque.h"
#include "myoid/model/body_model.h"
#include "myoid/run/study_inputs.h"
#include "myoid/run/trial_result.h"
#include "myoid/study/study.h"

namespace myoid {

/// The findings from which the data of a fit are made; the struct owns nothing.
struct FitSource {
  const Study& study;  ///< With the uses of the trials.
  const model::BodyModel& model;
  const std::vector<TrialResult>& trials;
  const std::vector<identification::RestingJoint>& resting;
  std::vector<const TimeSeries*> activation;  ///< One per trial; empty series: no EMG.
  const EmgScale& scale;                      ///< Scale of `activation`.
};

/// Returns a run's own trials as a source.
[[nodiscard]] FitSource fit_source(const StudySource& source,
                                   const std::vector<TrialResult>& trials,
                                   const std::vector<identification::RestingJoint>& resting,
                                   const EmgScale& scale);

}  // namespace myoid
