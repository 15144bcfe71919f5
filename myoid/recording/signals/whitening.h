#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/time_series.h"

namespace myoid::recording {

/// A channel's filter before rectification; it is symmetric and so has no delay.
struct WhiteningFilter {
  std::string channel;
  double rate_hz = 0.0;
  Eigen::VectorXd half;  ///< Taps 0, 1, ... to one side; the other side is equal. Empty without a filter.
  /// Statistical bandwidth of the muscle's EMG at a small effort, before and after, with the noise taken into account.
  /// The relative spread of an envelope is inversely proportional to the root of the bandwidth.
  double bandwidth_before_hz = 0.0, bandwidth_after_hz = 0.0;
  std::string reason;  ///< Reason for having no filter; empty if there is one.
};

/// Designs the filter whose mean square best estimates the amplitude s of EMG with power s^2 S(f)
/// in noise N(f): |H|^2 = S / (s^2 S + N)^2, the score of the Gaussian likelihood. Where the muscle
/// prevails the filter whitens, 1 / (s^2 sqrt(S)) (Hogan & Mann 1980; Clancy & Hogan 1994). Where
/// noise prevails it is sqrt(S) / N, which does not amplify noise (Clancy & Farry 2000).
///
/// S and N come from the recording. N is the mean spectrum of quiet segments, whose power is at most 1.5 times that of
/// the quietest second. Active segments of 0.25 s have more than three times the quiet power; s^2 S is the mean of
/// their spectra above N, with equal weights. s^2 is the lower quartile of their powers: a filter for small efforts
/// loses 3 % at great ones, while a filter for great efforts loses far more at small ones. If the muscle is never
/// quiet, N holds some of S, which does not change the shape of the difference. Signal below three times its standard
/// error counts as noise. Below 1.25 times the high-pass and above 0.45 of the rate |H| is constant, so that
/// frequencies that a filter removed do not return. |H|^2 spans at most 30 dB. The power of the contraction is kept, so
/// that the envelope stays in volts.
///
/// If no segment is active and none is quiet, as in an effort sustained from the first sample to the last, N is taken
/// as white, with the least density between those limits or a hundredth of the mean density.
///
/// The trials are EMG of one person and one placement of the electrodes, high-passed, with hum removed. A channel has
/// no filter if its rate is below 500 Hz or differs between the trials, or if some segments are active but fewer than
/// 20. Throws InvalidInput unless all trials have the channels of the first.
[[nodiscard]] std::vector<WhiteningFilter> design_whitening(std::span<const TimeSeries* const> trials,
                                                            double highpass_hz);

/// The decision on whitening, one for all channels and trials. Whitened and plain amplitudes differ
/// in noise and in the effect of fatigue, so that a mixture would make left and right incomparable.
struct Whitening {
  bool applied = false;
  std::string reason;                    ///< Reason of the decision, as a clause.
  std::vector<WhiteningFilter> filters;  ///< One for each channel; empty if no filters were designed.
};

/// Decides for the trials of `design_whitening`. Without `wanted`, whitens if every EMG channel has a filter and the
/// geometric mean of the bandwidths grows by more than a tenth. Spare inputs (`named_as_input`) have no vote beside
/// EMG. Throws InvalidInput as `design_whitening`, and where `wanted` is true and an EMG channel has no filter.
[[nodiscard]] Whitening decide_whitening(std::span<const TimeSeries* const> trials,
                                         double highpass_hz,
                                         std::optional<bool> wanted = std::nullopt);

/// Filters every channel if whitening is applied. Within the filter's reach of an end (16 ms) the filter lacks samples,
/// and no extrapolation helps: the filter amplifies frequencies at which EMG has hardly any power, and every kink has
/// some there. These samples, and signals of less than three reaches, stay unfiltered; their power is the same.
[[nodiscard]] TimeSeries whiten(const TimeSeries& emg, const Whitening& whitening);

}  // namespace myoid::recording
