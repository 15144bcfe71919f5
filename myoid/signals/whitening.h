#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/time_series.h"

namespace myoid::signals {

/// A channel's filter before rectification: symmetric, so that nothing is delayed.
struct WhiteningFilter {
  std::string channel;
  double rate_hz = 0.0;
  Eigen::VectorXd half;  ///< Taps 0, 1, ... to one side; the other side is the same. Empty: as is.
  /// Statistical bandwidth of the contracting muscle's EMG at a small effort, noise reckoned in:
  /// before and after. The relative spread of an envelope goes with the inverse root.
  double bandwidth_before_hz = 0.0, bandwidth_after_hz = 0.0;
  std::string reason;  ///< Why the channel stays as it is; empty if it does not.
};

/// The amplitude s of EMG of power s^2 S(f) in noise N(f) has one best quadratic estimate: the mean
/// square after a filter with |H|^2 = S / (s^2 S + N)^2 (score of the Gaussian likelihood). Where
/// the muscle stands out that is whitening, 1 / (s^2 sqrt(S)) (Hogan & Mann 1980; Clancy & Hogan
/// 1994), where noise prevails sqrt(S) / N, so that it does not raise noise (Clancy & Farry 2000).
///
/// S and N come from the recording: N is the mean spectrum of what is not above 1.5 times the
/// power of the quietest second, s^2 S what the segments of 0.25 s with more than three times the
/// quiet power have above N, each segment counting the same, s^2 their lower quartile: at great
/// efforts a filter for small ones loses 3 %, the other way round far more. Where nothing is ever
/// quiet, N holds some of S, which the difference leaves in its shape. What stands out less than
/// three times its standard error counts as noise. Below 1.25 times the high-pass and above 0.45 of
/// the rate |H| is held level: what a filter took away is not brought back; at most 30 dB between
/// the least and the greatest. The power of the contraction stays as it was, so that the envelope
/// stays in volts.
///
/// The trials are EMG of one person and one placement of the electrodes, high-passed, hum taken
/// out. A channel stays as it is if its rate is below 500 Hz or differs between the trials, if
/// fewer than 20 segments stand out, or if its bandwidth would grow by less than a tenth. Throws
/// InvalidInput unless all trials have the channels of the first.
[[nodiscard]] std::vector<WhiteningFilter> design_whitening(
    std::span<const TimeSeries* const> trials, double highpass_hz);

/// Every channel through its filter; beyond the ends the signal is mirrored.
[[nodiscard]] TimeSeries whiten(const TimeSeries& emg, std::span<const WhiteningFilter> filters);

}  // namespace myoid::signals
