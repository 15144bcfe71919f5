#pragma once

#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/recording/c3d/c3d_file.h"

namespace myoid::recording {

/// Makes a C3D file of markers and analog channels in the units of laboratories: mm, and the channels' own units (N, N
/// mm for moments, V). `analog` may be empty. Its clock must be the markers' clock or a whole multiple of that rate,
/// over the same time. Throws InvalidInput if the clocks do not fit.
[[nodiscard]] C3dFile make_c3d(const MarkerSeries& markers, const TimeSeries& analog);

}  // namespace myoid::recording
