#pragma once

#include <vector>

#include "myoid/core/progress.h"
#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/run/fit_input.h"
#include "myoid/signals/emg_envelope.h"

namespace myoid {

/// Makes the data of the estimators: the muscles, every moving trial with EMG (no MVC, static or passive trial) over
/// the time with EMG, and the rules of the parameters. The nuisances' rules come first, so that the study's own win.
[[nodiscard]] identification::StudyData estimator_data(const FitSource& source);

/// Returns the study's choices about the estimator.
[[nodiscard]] identification::EstimatorSettings estimator_settings(const Study& study);

/// Returns the facts about the activations that follow from the EMG's normalisation, with the gains' priors.
[[nodiscard]] identification::ActivationSource activation_source(
    const Study& study, const std::vector<signals::ChannelNormalisation>& normalisation);

/// Makes the estimator's options from both. Only the stop of `progress` is passed on.
[[nodiscard]] identification::EstimatorOptions torque_options(
    const Study& study, const std::vector<signals::ChannelNormalisation>& normalisation, const Progress& progress);

}  // namespace myoid
