#pragma once

#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

using TorqueOptions = EstimatorOptions;

/// Fits all muscles of the joints and both branches together, from all calibration trials, to the
/// torque of inverse dynamics:
///
///   T^(t) = sum_i r_i F_i(g a_i(t - d), l_i, v_i; x_i),     residual L(T^ - T)/s,  L a low-pass
///
/// The unknowns are F_max, l0, l_sh, V_sh, P and V_ml of each muscle (positive ones as logarithms),
/// the EMG delay d, a gain g per EMG channel, and further numbers that `StudyData::rules` free.
/// Priors are further residuals, and all unknowns have bounds. The search is Levenberg-Marquardt
/// with analytic derivatives. The standard deviation of a sample is
///
///   s^2 = s_T^2 + c_a^2 sum_channels (sum_i in channel r_i F_i)^2
///         + (dT/dq s_q)^2 + (dT/dqdot s_qdot)^2
///
/// (torque noise, the multiplicative noise of an EMG envelope, and the errors of the motion). Each of four passes finds
/// s_T and c_a from the residuals and holds them. The data count as their effective number of independent samples. The
/// covariance is the sandwich A^-1 B A^-1 with B from Newey and West within trials, lag 0.4 s; further routes over
/// trials, by bootstrap and profiles are optional. With `choose_lag` the fit is made twice, with a pure delay and with
/// a delay shared among lags (EmgLag). The result is the fit with the smaller residuals relative to their expectation;
/// both have the same number of unknowns.
/// Throws InvalidInput for data that do not fit together. A search that fails does not throw: read `termination`.
[[nodiscard]] IdentificationResult identify_torque(const StudyData& data, const TorqueOptions& options = {});

/// Identifies from data that may be free of noise, by either estimator. First comes a fit without priors, nuisances
/// (nuisances.h), weights and low-pass, from several starts (noise_free_solution). If it leaves less than 1e-6 of the
/// data's size, it is the result (`exact`, both readings equal), from all samples up to kNoiseFreeRate_hz. Else v_max
/// of the muscles in `speed_may_be_free` is freed (free_speeds) and the fit repeated, or the EMG's exponents are freed.
/// If these fail, too, `identify_torque` gives the result, with the nuisances and the freed v_max.
[[nodiscard]] IdentificationResult identify_torque_or_exact(const StudyData& data,
                                                            const TorqueOptions& options = {},
                                                            const std::vector<std::string>& speed_may_be_free = {});

/// Adds a warning to the result of these data, and makes every `identified` number `weak`, where
/// told_by_motion_alone reaches VerdictRules::motion_alone.
void judge_motion_alone(const StudyData& data, IdentificationResult& result);

}  // namespace myoid::identification
