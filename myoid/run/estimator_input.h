#pragma once

#include <vector>

#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/ground/core/progress.h"
#include "myoid/recording/signals/emg_envelope.h"
#include "myoid/run/fit_input.h"

namespace myoid::run {

/// Makes the data of the estimators: the muscles, every moving trial with EMG (no MVC, static or passive trial) over
/// the time with EMG, and the rules of the parameters. The nuisances' rules come first, so that the study's own win.
[[nodiscard]] fit::StudyData estimator_data(const FitSource& source);

/// Returns the study's choices about the estimator.
[[nodiscard]] fit::EstimatorSettings estimator_settings(const study::Study& study);

/// Returns the facts about the activations that follow from the EMG's normalisation, with the gains' priors.
[[nodiscard]] fit::ActivationSource activation_source(
    const study::Study& study, const std::vector<recording::ChannelNormalisation>& normalisation);

/// Makes the estimator's options from both. Only the stop of `progress` is passed on.
[[nodiscard]] fit::EstimatorOptions torque_options(const study::Study& study,
                                                   const std::vector<recording::ChannelNormalisation>& normalisation,
                                                   const Progress& progress);

}  // namespace myoid::run
