#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/envelope.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/posterior/noise_model.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::fit {

/// Returns the standard deviation of an envelope of size u after subtraction of the electrode's
/// noise as power, u^2 = m^2 - rest^2: du = (v + rest^2 / v) dm / m, dm / m = `noise_sd`. v is the
/// root of u^2 + noise_sd rest^2: below rest sqrt(noise_sd) chance makes u. A bound on u in place
/// of v would give the posterior a kink at each sample that passes it, at which searches end.
[[nodiscard]] double envelope_sd_at(double u, double noise_sd, double rest);

/// Holds the ratio of envelope_sd_at to `noise_sd` u, and the slope of this ratio in u. The root of
/// u^2 + (1e-4 rest)^2 stands for the divisor u, again without a kink.
struct NoiseOverEnvelope {
  double value = 1.0, slope = 0.0;
};
[[nodiscard]] NoiseOverEnvelope noise_over_envelope(double u, double noise_sd, double rest);

/// The expectation of an EMG channel's drive, given its recorded envelope u. Drive and noise are
/// stationary, and Wiener's filter separates them,
///
///   W(f) = S(f) / P(f),    S = max(P - N, 0),   P the spectrum of u, N that of its noise
///
/// W falls with f (monotone least-squares fit). N has the relative size `noise_sd`, scaled so that N matches P in the
/// upper half of the envelope's band, where there is hardly a drive, but to at most 3.3 times the expected power. A
/// model that takes u for the drive finds lags that do not exist, because a lag damps the noise of u, too. The
/// remaining error has the spectrum (1 - W)^2 S + W^2 N. A constant envelope is its own drive.
///
/// The noise is larger in a burst than at rest, so that the filter takes more of a burst: one to five percent, by which
/// muscles would be found too strong. The filtered envelope d is therefore multiplied by
///
///   b = (sum h^2 d u - sum h^2 E) / sum h^2 d^2,
///
/// h a Hann window and E the variance of d's error, which is the covariance of d with the noise of u.
struct Drive {
  Envelope envelope;  ///< The drive as an envelope.
  /// Power of the drive's error over N, at the frequencies of `EnvelopeError`.
  Eigen::VectorXd left;
};
[[nodiscard]] Drive drive_behind(
    const Envelope& recorded, double noise_sd, double rest, const EnvelopeError& error, double cutoff_hz);

/// Returns the drive of an envelope without noise, as of a planned movement: the envelope itself. `left` is that of
/// Wiener's filter of a recording whose noise has `level` times the expected power N, level S / (S + level N).
[[nodiscard]] Drive drive_of_clean(
    const Envelope& clean, double noise_sd, double rest, const EnvelopeError& error, double cutoff_hz, double level);

/// The drives that fits of one recording have found: its folds and predictions need the same ones.
/// Several threads may ask at once.
class DriveMemory {
 public:
  DriveMemory() = default;
  /// A memory of planned movements, whose envelopes hold no noise (drive_of_clean).
  explicit DriveMemory(double level_of_clean) : level_of_clean_(level_of_clean) {}
  /// A memory of a fold, which knows the drives of `whole` and keeps its own.
  explicit DriveMemory(std::shared_ptr<const DriveMemory> whole) : whole_(std::move(whole)) {}

  /// Returns drive_behind of the channel, found once for each envelope and noise.
  [[nodiscard]] std::shared_ptr<const Drive> behind(const TimeSeries& recorded,
                                                    const std::string& channel,
                                                    double noise_sd,
                                                    double rest,
                                                    const EnvelopeError& error,
                                                    double cutoff_hz);

 private:
  using Key = std::vector<double>;  ///< All that the drive depends on.
  /// Returns the drive, or nullptr if neither this memory nor that of the whole knows it.
  [[nodiscard]] std::shared_ptr<const Drive> known(const Key& key) const;

  std::optional<double> level_of_clean_;
  std::shared_ptr<const DriveMemory> whole_;
  mutable std::mutex mutex_;
  std::map<Key, std::shared_ptr<const Drive>> drives_;
};

}  // namespace myoid::fit
