#pragma once

#include <array>

#include <Eigen/Core>

namespace myoid::identification {

struct SmoothPrediction {
  Eigen::VectorXd torque_nm;
  double cutoff_hz = 0.0;  ///< 0: as it was.
};

/// The noise of the envelopes in a torque that is predicted from them.
struct EnvelopeNoise {
  double variance_nm2 = 0.0;      ///< Before the lags.
  double cutoff_hz = 0.0;         ///< Of the envelopes' low-pass, behind which it was white.
  std::array<double, 2> lag_s{};  ///< Time constants of the lags that it passes, a gain of
                                  ///< 1 / sqrt(1 + (2 pi f tau)^2) each; 0: none.
};

/// Share of the variance of the noise that passes the lags.
[[nodiscard]] double share_behind_lags(const EnvelopeNoise& noise);

/// A torque predicted from EMG, below the cut-off at which it is expected to come closest to what
/// it would be without the noise of the envelopes. Of y = s + n, n of known variance and spectrum,
/// a smoother L errs by
///
///   E |L y - s|^2 = E |L y - y|^2 + (2 rho(L) - 1) E n^2,   rho = share of the noise in its band,
///
/// (Mallows 1973; Stein 1981), which needs nothing but the prediction itself: the measured torque
/// has no part in it. Cut-offs from 0.7 Hz in steps of an eighth up to the envelope's, two passes
/// of second order, no delay. A clock that is uneven or too slow, or no noise: as it was.
[[nodiscard]] SmoothPrediction smooth_prediction(const Eigen::VectorXd& time_s,
                                                 const Eigen::VectorXd& predicted_nm,
                                                 const EnvelopeNoise& noise);

}  // namespace myoid::identification
