#pragma once

#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/marker_series.h"

namespace myoid::recording {

/// Removes from every channel the frequencies that a clock of `rate_hz` cannot hold, by a symmetric FIR low-pass
/// without delay: the sinc of 0.9 rate_hz / 2 under a Kaiser window of 64 samples of the new clock and beta = 10.06.
/// With N = rate_hz / 2, the gain is 1 within 1e-5 below 0.8 N, 1/2 (-6 dB) at 0.9 N, and below 1e-5 (-100 dB) above N.
/// The ends are extended by odd reflection. The clock stays; a series that is no faster than `rate_hz` is returned
/// unchanged. Throws InvalidInput if a value is not finite.
[[nodiscard]] TimeSeries anti_aliased(const TimeSeries& series, double rate_hz);

/// Resamples the series to another clock. For a clock that is slower by 1 % or more, the series is low-passed as in
/// `anti_aliased` with that clock's mean rate. Otherwise a cubic spline goes through the samples; its error for a sine
/// is below 0.1 % up to a tenth of the old rate. Such a spline first makes an uneven old clock even. Times outside the
/// series take the nearest end value. Throws InvalidInput if a value is not finite.
[[nodiscard]] TimeSeries resample(const TimeSeries& series, const Eigen::VectorXd& time_s);

/// Returns evenly spaced times from start to end at about `rate_hz`, with both ends.
[[nodiscard]] Eigen::VectorXd even_clock(double start_s, double end_s, double rate_hz);

/// Resamples markers to another clock: each stretch in which a marker is seen as above, nothing
/// across its gaps. Stretches of fewer than four frames are dropped.
[[nodiscard]] MarkerSeries resample(const MarkerSeries& markers, const Eigen::VectorXd& time_s);

}  // namespace myoid::recording
