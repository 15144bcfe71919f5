#pragma once

#include <map>
#include <string>
#include <vector>

#include "myoid/core/progress.h"
#include "myoid/identification/result.h"
#include "myoid/identification/study_data.h"

namespace myoid::identification {

struct TorqueOptions {
  std::vector<std::string> muscles;  ///< To identify; the others keep their start. Empty: all.
  bool priors = true;
  std::optional<double> delay_s;  ///< Held at this; empty: estimated, with a prior.
  double delay_prior_mean_s = 0.06;
  double delay_prior_sd_s = 0.02;
  double delay_limit_s = 0.15;
  /// EMG channels whose gain is a nuisance about 1, with the standard deviation of its logarithm:
  /// the uncertainty of the normalisation, which F_max inherits. Empty: no gains.
  std::map<std::string, double> gain_prior_sd;
  double max_rate_hz = 50.0;  ///< Samples are thinned to at most this; torque and EMG hold 6 Hz.
  /// Both sides of the residual are low-passed here (two passes, -3 dB). T^ is linear in the
  /// envelope, whose noise reaches further up than what tells muscles apart: what is cut off would
  /// only pull F_max towards zero (errors in the regressors). Empty: not at all.
  std::optional<double> residual_cutoff_hz = 2.0;
  bool weights = true;  ///< Heteroscedastic weights and the effective number of samples; false:
                        ///< plain least squares.
  int passes = 4;       ///< Of finding the noise and weighting by it.
  int starts = 3;       ///< The given start and moved ones; the best is kept.
  Eigen::VectorXd warm_start;  ///< IdentificationResult::solution of a kindred fit, to begin there;
                               ///< empty: the muscles' start.
  bool from_mvc = true;        ///< For the verdicts.
  Progress progress;
};

/// All muscles of a joint and both branches at once, from all calibration trials, against the
/// torque of inverse dynamics:
///
///   T^(t) = sum_i r_i F_i(g a_i(t - d), l_i, v_i; x_i),     residual L(T^ - T)/s,  L a low-pass
///
/// with unknown F_max, l0, l_sh, V_sh, P and V_ml of each muscle (positive ones as logarithms), the
/// EMG delay d and a gain g per EMG channel; priors as further residuals; bounds.
/// Levenberg-Marquardt with analytic derivatives. The standard deviation of a sample is
///
///   s^2 = s_T^2 + c_a^2 sum_channels (sum_i in channel r_i F_i)^2
///
/// (torque noise, and the multiplicative noise of an EMG envelope), both found from the residuals
/// and held within a pass, four passes; data count as their effective number of independent
/// samples. Covariance: sandwich A^-1 B A^-1 with B from Newey and West within trials, lag 0.4 s.
/// Throws InvalidInput for data that do not fit together. A search that fails does not throw: read
/// `termination`.
[[nodiscard]] IdentificationResult identify_torque(const StudyData& data,
                                                   const TorqueOptions& options = {});

/// Torque of each muscle set over a trial with given parameters, delay and gains of 1.
struct Prediction {
  Eigen::MatrixXd force_n;    ///< n x m
  Eigen::VectorXd torque_nm;  ///< n
};
[[nodiscard]] Prediction predict(const StudyData& data,
                                 const TrialData& trial,
                                 const std::vector<muscle::HillParameters<double>>& muscles,
                                 double delay_s);

/// 1 - SSE/SST; 0 if the reference is constant.
[[nodiscard]] double coefficient_of_determination(const Eigen::VectorXd& reference,
                                                  const Eigen::VectorXd& predicted);

}  // namespace myoid::identification
