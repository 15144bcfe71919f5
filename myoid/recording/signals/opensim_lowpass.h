#pragma once

#include "myoid/ground/core/time_series.h"

namespace myoid::recording {

/// Filters a motion as OpenSim's tools do if a set-up file gives a cut-off. Half a record is added at both ends by odd
/// reflection (of the times too). Unless the samples are even to 2e-16 s, the natural quintic spline resamples the
/// whole at its smallest interval, with times that add up interval by interval. A Butterworth filter of third order
/// runs forwards and backwards; the first three outputs of each pass are its inputs. The added ends remain. The two
/// passes together halve the amplitude at `cutoff_hz`; a cut-off at or above half the rate becomes 0.49 of the rate.
/// Throws InvalidInput if the cut-off is not above 0, if there are fewer than four samples, or if the smallest interval
/// would make more than ten million of them.
[[nodiscard]] TimeSeries opensim_lowpass(const TimeSeries& motion, double cutoff_hz);

}  // namespace myoid::recording
