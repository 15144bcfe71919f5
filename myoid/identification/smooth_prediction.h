#pragma once

#include <Eigen/Core>

namespace myoid::identification {

struct SmoothPrediction {
  Eigen::VectorXd torque_nm;
  double cutoff_hz = 0.0;  ///< 0: as it was.
};

/// A torque predicted from EMG, below the cut-off at which it is expected to come closest to what
/// it would be without the noise of the envelopes. Of y = s + n, n of known variance
/// `noise_nm2` and with the spectrum that the envelopes' low-pass at `envelope_cutoff_hz` leaves of
/// white noise, a smoother L errs by
///
///   E |L y - s|^2 = E |L y - y|^2 + (2 rho(L) - 1) noise,   rho = share of the noise in its band,
///
/// (Mallows 1973; Stein 1981), which needs nothing but the prediction itself: the measured torque
/// has no part in it. Cut-offs from 0.7 Hz in steps of an eighth up to the envelope's, two passes
/// of second order, no delay. A clock that is uneven or too slow, or no noise: as it was.
[[nodiscard]] SmoothPrediction smooth_prediction(const Eigen::VectorXd& time_s,
                                                 const Eigen::VectorXd& predicted_nm,
                                                 double noise_nm2,
                                                 double envelope_cutoff_hz);

}  // namespace myoid::identification
