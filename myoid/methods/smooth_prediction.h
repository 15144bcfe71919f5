#pragma once

#include <array>

#include <Eigen/Core>

namespace myoid::identification {

struct SmoothPrediction {
  Eigen::VectorXd torque_nm;
  double cutoff_hz = 0.0;  ///< 0: not smoothed.
};

/// The noise of the envelopes in a torque that is predicted from them.
struct EnvelopeNoise {
  double variance_nm2 = 0.0;      ///< Variance before the lags.
  double cutoff_hz = 0.0;         ///< Cut-off of the envelopes' low-pass; before it the noise is white.
  std::array<double, 2> lag_s{};  ///< Time constants of the lags after the low-pass; each has the
                                  ///< gain 1 / sqrt(1 + (2 pi f tau)^2); 0: none.
};

/// Returns the share of the noise's variance that passes the lags.
[[nodiscard]] double share_behind_lags(const EnvelopeNoise& noise);

/// Smooths a torque predicted from EMG at the cut-off where it is expected to come closest to the torque without the
/// noise of the envelopes. For y = s + n with known variance and spectrum of n, the error of a smoother L is
///
///   E |L y - s|^2 = E |L y - y|^2 + (2 rho(L) - 1) E n^2,   rho = share of the noise in its band,
///
/// (Mallows 1973; Stein 1981). It needs only the prediction, not the measured torque. Cut-offs go
/// from 0.7 Hz in steps of an eighth up to the envelope's, with two passes of second order and no
/// delay. A torque on an uneven or too slow clock, or without noise, stays unchanged.
[[nodiscard]] SmoothPrediction smooth_prediction(const Eigen::VectorXd& time_s,
                                                 const Eigen::VectorXd& predicted_nm,
                                                 const EnvelopeNoise& noise);

}  // namespace myoid::identification
