#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/time_series.h"
#include "myoid/identification/envelope.h"
#include "myoid/identification/options.h"
#include "myoid/posterior/noise_model.h"

namespace myoid::identification {

/// Standard deviation of an envelope of size u from which the noise of the electrode has been taken
/// as power, u^2 = m^2 - rest^2: du = (u + rest^2 / u) dm / m, dm / m = `noise_sd`. Below
/// u = rest sqrt(noise_sd), where chance makes u, du stays.
[[nodiscard]] double envelope_sd_at(double u, double noise_sd, double rest);

/// That standard deviation over `noise_sd` u, and its slope in u.
struct NoiseOverEnvelope {
  double value = 1.0, slope = 0.0;
};
[[nodiscard]] NoiseOverEnvelope noise_over_envelope(double u, double noise_sd, double rest);

/// The expectation of the drive of an EMG channel, given its recorded envelope u: drive and noise
/// are stationary, and Wiener's filter tells them apart,
///
///   W(f) = S(f) / P(f),    S = max(P - N, 0),   P the spectrum of u, N that of its noise
///
/// W falls with f (the monotone fit of least squares), N has the relative size `noise_sd` and is
/// set to P in the upper half of the envelope's band, where there is hardly a drive, but to at most
/// 3.3 times the expected power. A model
/// that takes u for the drive finds lags that are not there, for a lag damps the noise of u, too.
/// The error that is left has the spectrum (1 - W)^2 S + W^2 N. An envelope that never changes is
/// its own drive.
struct Drive {
  Envelope envelope;     ///< Of the drive.
  Eigen::VectorXd left;  ///< Power of its error over N, at the frequencies of `EnvelopeError`.
};
[[nodiscard]] Drive drive_behind(const Envelope& recorded,
                                 double noise_sd,
                                 double rest,
                                 const EnvelopeError& error,
                                 double cutoff_hz);

/// The drives that fits of one recording have found: its folds and predictions need the same ones.
/// Several threads may ask at once.
class DriveMemory {
 public:
  /// Returns drive_behind of the channel, found once for each envelope and noise.
  [[nodiscard]] std::shared_ptr<const Drive> behind(const TimeSeries& recorded,
                                                    const std::string& channel,
                                                    double noise_sd,
                                                    double rest,
                                                    const EnvelopeError& error,
                                                    double cutoff_hz);

 private:
  using Key = std::vector<double>;  ///< All that the drive depends on.
  std::mutex mutex_;
  std::map<Key, std::shared_ptr<const Drive>> drives_;
};

/// Returns the options with a memory of drives, where the estimator is the posterior.
[[nodiscard]] EstimatorOptions remembering_drives(EstimatorOptions options);

}  // namespace myoid::identification
