#pragma once

#include "myoid/core/time_series.h"

namespace myoid::signals {

/// The series on another clock, by cubic interpolation; low-pass it first if the new clock is
/// slower than twice its highest frequency. Times outside the series take the nearest end value.
/// Throws InvalidInput if a value is not finite.
[[nodiscard]] TimeSeries resample(const TimeSeries& series, const Eigen::VectorXd& time_s);

/// Evenly spaced times from start to end at about `rate_hz`, both ends included.
[[nodiscard]] Eigen::VectorXd even_clock(double start_s, double end_s, double rate_hz);

}  // namespace myoid::signals
