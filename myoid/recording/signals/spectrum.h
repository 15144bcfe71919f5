#pragma once

#include <Eigen/Core>

#include "myoid/ground/core/time_series.h"

namespace myoid::recording {

/// One-sided power spectrum: the sum over the bins times their width is the mean square.
struct PowerSpectrum {
  Eigen::VectorXd frequency_hz;  ///< Bins from 0 to half the sampling rate.
  Eigen::VectorXd density;       ///< [x^2 / Hz]
};

/// Welch's estimate (1967): the mean of the periodograms of segments of `segment_s`, each without its mean, under a
/// Hann window, overlapping by half. With K segments the relative spread of a bin's density is about 1 / sqrt(K /
/// 1.06). A signal shorter than a segment is one segment. Throws InvalidInput unless there are at least 8 finite
/// samples and rate and segment are positive.
[[nodiscard]] PowerSpectrum power_spectrum(const Eigen::VectorXd& x, double rate_hz, double segment_s = 1.0);

/// Returns the power in low_hz..high_hz [x^2]; a bin at the edge counts by its part.
[[nodiscard]] double band_power(const PowerSpectrum& spectrum, double low_hz, double high_hz);

/// Returns the frequency that halves the power in low_hz..high_hz, interpolated within its bin; NaN
/// without power there.
[[nodiscard]] double median_frequency_hz(const PowerSpectrum& spectrum, double low_hz, double high_hz);

inline constexpr double kSpectrumSegment_s = 0.25;  ///< Segment of Welch's estimate for bandwidth and median.

/// Returns (sum S)^2 / sum S^2 times the width of a bin [Hz]: the width of a flat spectrum whose power fluctuates as
/// much. The relative spread of the mean square over T is then 1 / sqrt(B T) (Bendat & Piersol). NaN without power.
[[nodiscard]] double statistical_bandwidth_hz(const PowerSpectrum& spectrum);

struct MedianFrequencyOptions {
  double window_s = 2.0;   ///< Length of a window; windows follow each other without overlap.
  double low_hz = 20.0;    ///< Motion artefacts are below.
  double high_hz = 400.0;  ///< At most 0.9 of half the sampling rate is used.
  /// Root mean square of each channel's resting level [as the EMG]; empty if unknown. A window with
  /// less than four times that power gives NaN: the muscle is hardly active.
  Eigen::VectorXd resting_rms;
};

/// Returns the median frequency [Hz] of every channel of a raw EMG, one row a window, at its middle. It falls as a
/// muscle tires, because conduction slows (De Luca 1997). An incomplete last window is left out. Throws InvalidInput
/// for an uneven clock, a rate below 4 low_hz, or a resting level for another number of channels.
[[nodiscard]] TimeSeries median_frequency(const TimeSeries& raw, const MedianFrequencyOptions& options = {});

}  // namespace myoid::recording
