#pragma once

#include "myoid/core/progress.h"
#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/pipeline/study_result.h"

namespace myoid::pipeline {

/// What the estimators see of a study whose trials are computed: the muscles, every trial that
/// moves and has EMG (but MVC, static and passive ones) over the time that has EMG, and the rules
/// of the parameters: those of the nuisances first, so that the study's own win.
[[nodiscard]] identification::StudyData estimator_data(const StudyResult& result);

/// How the study wants its parameters found, with the gains' priors from the normalisation of the
/// EMG. Of `progress` only the stop is passed on.
[[nodiscard]] identification::TorqueOptions torque_options(const StudyResult& result,
                                                           const Progress& progress);

}  // namespace myoid::pipeline
