#pragma once

#include <Eigen/Core>

#include "myoid/core/time_series.h"

namespace myoid::signals {

/// Power over frequency, one-sided: the sum over the bins times their width is the mean square.
struct PowerSpectrum {
  Eigen::VectorXd frequency_hz;  ///< Bins from 0 to half the sampling rate.
  Eigen::VectorXd density;       ///< [x^2 / Hz]
};

/// Welch's estimate (1967): mean of the periodograms of segments of `segment_s`, each without its
/// mean, under a Hann window, overlapping by half. With K segments the density of a bin spreads by
/// about 1 / sqrt(K / 1.06) of itself. A signal shorter than a segment is one segment. Throws
/// InvalidInput unless there are at least 8 finite samples and rate and segment are positive.
[[nodiscard]] PowerSpectrum power_spectrum(const Eigen::VectorXd& x,
                                           double rate_hz,
                                           double segment_s = 1.0);

/// Power in low_hz..high_hz [x^2]; a bin that is cut counts by its part.
[[nodiscard]] double band_power(const PowerSpectrum& spectrum, double low_hz, double high_hz);

/// The frequency that halves the power in low_hz..high_hz, interpolated within its bin; NaN without
/// power there.
[[nodiscard]] double median_frequency_hz(const PowerSpectrum& spectrum,
                                         double low_hz,
                                         double high_hz);

/// (sum S)^2 / sum S^2 times the width of a bin [Hz]: the width of a flat spectrum whose power
/// fluctuates as much. The mean square over T then spreads by 1 / sqrt(B T) of itself (Bendat &
/// Piersol). NaN without power.
[[nodiscard]] double statistical_bandwidth_hz(const PowerSpectrum& spectrum);

struct MedianFrequencyOptions {
  double window_s = 2.0;    ///< Consecutive windows, no overlap.
  double segment_s = 0.25;  ///< Of Welch's estimate within a window.
  double low_hz = 20.0;     ///< Below lie motion artefacts.
  double high_hz = 400.0;   ///< Or 0.9 of half the sampling rate, if lower.
  /// Root mean square of each channel's resting level [as the EMG]; empty: not known. A window with
  /// less than `signal_to_noise` times that power holds no muscle to speak of: NaN.
  Eigen::VectorXd resting_rms;
  double signal_to_noise = 4.0;
};

/// Median frequency [Hz] of every channel of a raw EMG, one row per window, at its middle. It falls
/// as a muscle tires (conduction slows; De Luca 1997). A last window that is not whole is left out.
/// Throws InvalidInput for a clock that is not even, a rate below 4 low_hz, or a resting level
/// for another number of channels.
[[nodiscard]] TimeSeries median_frequency(const TimeSeries& raw,
                                          const MedianFrequencyOptions& options = {});

}  // namespace myoid::signals
