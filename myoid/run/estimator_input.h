#pragma once

#include "myoid/core/progress.h"
#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/run/study_result.h"

namespace myoid {

/// What the estimators see of a study whose trials are computed: the muscles, every trial that
/// moves and has EMG (but MVC, static and passive ones) over the time that has EMG, and the rules
/// of the parameters: those of the nuisances first, so that the study's own win.
[[nodiscard]] identification::StudyData estimator_data(const StudyResult& result);
/// The same with other uses of the trials (those of `study`) and other activations.
[[nodiscard]] identification::StudyData estimator_data(const StudyResult& result,
                                                       const Study& study,
                                                       const StudyActivations& emg);

/// How the study wants its parameters found, with the gains' priors from the normalisation of the
/// EMG. Of `progress` only the stop is passed on.
[[nodiscard]] identification::TorqueOptions torque_options(const StudyResult& result,
                                                           const Progress& progress);
[[nodiscard]] identification::TorqueOptions torque_options(
    const Study& study,
    const std::vector<signals::ChannelNormalisation>& normalisation,
    const Progress& progress);

/// The envelope passes the lags of equation (1) (`dynamics`), and the pure delay is what is left
/// beside them: 10 +- 10 ms in place of 60 +- 20 ms, which by cross-correlation of EMG and force
/// hold both (tau_ne + tau_ac are some 55 ms of them).
void use_dynamics(identification::EstimatorOptions& options);

}  // namespace myoid
