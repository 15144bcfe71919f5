#pragma once

#include <optional>
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
  Eigen::VectorXd half;  ///< Taps 0, 1, ... to one side; the other side is the same. Empty: none.
  /// Statistical bandwidth of the contracting muscle's EMG at a small effort, noise reckoned in:
  /// before and after. The relative spread of an envelope goes with the inverse root.
  double bandwidth_before_hz = 0.0, bandwidth_after_hz = 0.0;
  std::string reason;  ///< Why there is no filter; empty if there is.
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
/// Where no segment stands out and none is quiet, such as an effort held from the first sample to
/// the last, N is taken for white, of the least density between those limits or a hundredth of the
/// mean one.
///
/// The trials are EMG of one person and one placement of the electrodes, high-passed, hum taken
/// out. A channel has no filter if its rate is below 500 Hz or differs between the trials, or if
/// some segments stand out but fewer than 20. Throws InvalidInput unless all trials have the
/// channels of the first.
[[nodiscard]] std::vector<WhiteningFilter> design_whitening(
    std::span<const TimeSeries* const> trials, double highpass_hz);

/// The answer to the question if EMG is whitened: one answer for all channels and trials, because a
/// whitened amplitude and one that is not differ in noise and in how fatigue changes them, so that
/// left and right could not be compared.
struct Whitening {
  bool applied = false;
  std::string reason;                    ///< Of the answer, as a clause.
  std::vector<WhiteningFilter> filters;  ///< One for each channel; empty: nobody asked for it.
};

/// Decides for the trials of `design_whitening`. `wanted` absent: yes, if every EMG channel has a
/// filter and the bandwidth grows by more than a tenth, in their geometric mean. Spare inputs
/// (`named_as_input`) have no vote beside EMG. Throws InvalidInput as `design_whitening`, and where
/// `wanted` is true and an EMG channel has no filter.
[[nodiscard]] Whitening decide_whitening(std::span<const TimeSeries* const> trials,
                                         double highpass_hz,
                                         std::optional<bool> wanted = std::nullopt);

/// Every channel through its filter, if whitening is applied. Within the filter's reach of an end
/// (16 ms) the samples that it needs are not there, and no continuation will do: the filter raises
/// frequencies at which EMG has hardly any power, and every kink has some there. The signal stays
/// as it is in these samples, of the same power. So does a signal of less than three reaches.
[[nodiscard]] TimeSeries whiten(const TimeSeries& emg, const Whitening& whitening);

}  // namespace myoid::signals
