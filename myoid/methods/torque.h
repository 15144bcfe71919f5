#pragma once

#include <string_view>

#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

using TorqueOptions = EstimatorOptions;

/// All muscles of the joints and both branches at once, from all calibration trials, against the
/// torque of inverse dynamics:
///
///   T^(t) = sum_i r_i F_i(g a_i(t - d), l_i, v_i; x_i),     residual L(T^ - T)/s,  L a low-pass
///
/// with unknown F_max, l0, l_sh, V_sh, P and V_ml of each muscle (positive ones as logarithms), the
/// EMG delay d and a gain g per EMG channel, and whatever else `StudyData::rules` free; priors as
/// further residuals; bounds. Levenberg-Marquardt with analytic derivatives. The standard deviation
/// of a sample is
///
///   s^2 = s_T^2 + c_a^2 sum_channels (sum_i in channel r_i F_i)^2 + (dT/dq s_q)^2 + (dT/dqdot
///   s_qdot)^2
///
/// (torque noise, the multiplicative noise of an EMG envelope, and the errors of the motion); s_T
/// and c_a are found from the residuals and held within a pass, four passes; data count as their
/// effective number of independent samples. Covariance: sandwich A^-1 B A^-1 with B from Newey and
/// West within trials, lag 0.4 s; beside it over trials, bootstrap and profiles as asked for.
/// With `choose_lag` the fit is made twice, the delay as it is and shared among lags (EmgLag), and
/// the one whose residuals are smaller against what is expected of them is the answer: they have
/// as many unknowns.
/// Throws InvalidInput for data that do not fit together. A search that fails does not throw: read
/// `termination`.
[[nodiscard]] IdentificationResult identify_torque(const StudyData& data,
                                                   const TorqueOptions& options = {});

/// The same estimator for data that may be free of noise. A fit without priors, weights and
/// low-pass, from several starts (noise_free_solution), comes first; if it leaves less than 1e-6 of
/// the data's size, it is the answer (`exact`), of all samples up to kNoiseFreeRate_hz. Where
/// `speed_may_be_free` names muscles, their v_max is freed unless the data are met exactly without
/// (free_speeds). Else `identify_torque`.
[[nodiscard]] IdentificationResult identify_torque_or_exact(
    const StudyData& data,
    const TorqueOptions& options = {},
    const std::vector<std::string>& speed_may_be_free = {});

}  // namespace myoid::identification
