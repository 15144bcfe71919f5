#pragma once

#include "myoid/core/time_series.h"

namespace myoid::signals {

/// What OpenSim's tools make of a motion for which a set-up file gives a cut-off: half a record is
/// added at both ends by odd reflection (of the times too), the whole is sampled anew by the
/// natural quintic spline at its smallest interval, then a Butterworth filter of third order runs
/// forwards and backwards, the first three outputs of each pass being its inputs. The added ends
/// remain. The two passes together pass half of the amplitude at `cutoff_hz`; a cut-off at or above
/// half the rate becomes 0.49 of the rate. Throws InvalidInput if the cut-off is not above 0, if
/// there are fewer than four samples, or if the smallest interval would make more than ten million
/// of them.
[[nodiscard]] TimeSeries opensim_lowpass(const TimeSeries& motion, double cutoff_hz);

}  // namespace myoid::signals
