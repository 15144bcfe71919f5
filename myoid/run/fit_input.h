#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/ground/core/progress.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/run/resting_torque.h"
#include "myoid/run/trial_result.h"
#include "myoid/study/intake/study_activation.h"
#include "myoid/study/phases/phases.h"
#include "myoid/study/study.h"

namespace myoid::run {

/// The findings from which the data of a fit are made; the struct owns nothing.
struct FitSource {
  const study::Study& study;  ///< With the uses of the trials.
  const body::BodyModel& model;
  const std::vector<TrialResult>& trials;
  const std::vector<RestingJoint>& resting;
  std::vector<const TimeSeries*> activation;  ///< One per trial; empty series: no EMG.
  const study::EmgScale& scale;               ///< Scale of `activation`.
};

/// Says why the nuisances are held.
inline constexpr std::string_view kFewRows =
    "The trials hold few independent rows of torque for the unknowns of the muscles: exponents of the EMG, the joint's "
    "own torque and the shift of the optimal length with activation stay at their expected values. More trials would "
    "tell them; a parameter that is free by name is identified anyway.";

/// The data and the options of a fit.
struct FitInput {
  fit::StudyData data;  ///< Without the phases that the study excludes.
  fit::EstimatorOptions options;
  std::vector<study::TrialPhases> phases;  ///< Phases of the trials of `data`; empty: not searched.
  bool nuisances_held = false;             ///< The trials are too few to tell them (fit::tells_nuisances).
};

/// Makes the data of the estimators, their options and the phases of the trials. Of given activations the nuisances are
/// held if the trials do not tell them; `hold` decides that for a fold as for the whole.
[[nodiscard]] FitInput fit_input(const FitSource& source,
                                 const Progress& progress,
                                 std::optional<bool> hold = std::nullopt);

}  // namespace myoid::run
