#pragma once

#include "myoid/core/time_series.h"
#include "myoid/files/marker_series.h"

namespace myoid::signals {

/// Every channel without what a clock of `rate_hz` cannot hold: a symmetric FIR low-pass (no
/// delay), the sinc of 0.9 rate_hz / 2 under a Kaiser window of 64 samples of the new clock and
/// beta = 10.06. In numbers, with N = rate_hz / 2: below 0.8 N the gain is 1 within 1e-5, at 0.9 N
/// it is 1/2 (-6 dB), above N it is below 1e-5 (-100 dB). The ends are extended by odd reflection.
/// The clock stays; a series that is no faster than `rate_hz` comes back as it is. Throws
/// InvalidInput if a value is not finite.
[[nodiscard]] TimeSeries anti_aliased(const TimeSeries& series, double rate_hz);

/// The series on another clock. A slower clock (by 1 % or more): low-passed as `anti_aliased` does
/// for its mean rate. Otherwise by a cubic spline through the samples, whose error of a sine is
/// below 0.1 % up to a tenth of the old rate. An uneven old clock is made even by such a spline
/// first. Times outside the series take the nearest end value. Throws InvalidInput if a value is
/// not finite.
[[nodiscard]] TimeSeries resample(const TimeSeries& series, const Eigen::VectorXd& time_s);

/// Evenly spaced times from start to end at about `rate_hz`, both ends included.
[[nodiscard]] Eigen::VectorXd even_clock(double start_s, double end_s, double rate_hz);

/// Markers on another clock: each stretch in which a marker is seen as `resample` does, nothing
/// across its gaps. Stretches of fewer than four frames are left out.
[[nodiscard]] recording::MarkerSeries resample(const recording::MarkerSeries& markers,
                                               const Eigen::VectorXd& time_s);

}  // namespace myoid::signals
