#pragma once

#include <vector>

#include "myoid/core/progress.h"
#include "myoid/identification/estimator_settings.h"
#include "myoid/identification/study_data.h"
#include "myoid/run/fit_source.h"
#include "myoid/signals/emg_envelope.h"

namespace myoid {

/// The data of the estimators: the muscles, every trial that moves and has EMG (but MVC, static and
/// passive ones) over the time that has EMG, and the rules of the parameters: the nuisances' first,
/// so that the study's own win.
[[nodiscard]] identification::StudyData estimator_data(const FitSource& source);

/// The study's choices about the estimator.
[[nodiscard]] identification::EstimatorSettings estimator_settings(const Study& study);

/// The facts about the activations that the normalisation of the EMG tells, with the gains' priors.
[[nodiscard]] identification::ActivationSource activation_source(
    const Study& study, const std::vector<signals::ChannelNormalisation>& normalisation);

/// The estimator's options from both. Of `progress` only the stop is passed on.
[[nodiscard]] identification::EstimatorOptions torque_options(
    const Study& study,
    const std::vector<signals::ChannelNormalisation>& normalisation,
    const Progress& progress);

}  // namespace myoid
