#pragma once

#include "myoid/ground/core/time_series.h"
#include "myoid/ground/math/butterworth.h"
#include "myoid/ground/math/zero_phase.h"

namespace myoid::recording {

struct FilterOptions {
  int order = 2;                      ///< Order of one pass.
  bool corrected = true;              ///< True: the two passes together have -3 dB at the cut-off. False: each
                                      ///< pass has, as in the source paper.
  math::Ends ends = math::Ends::odd;  ///< `even` for EMG, raw or rectified.
};

/// Filters every channel forwards and backwards by a Butterworth filter, without delay. Throws InvalidInput if the
/// clock is uneven, a value is not finite, or the cut-off is not below half the rate.
[[nodiscard]] TimeSeries zero_phase_filter(const TimeSeries& series,
                                           math::FilterBand band,
                                           double cutoff_hz,
                                           const FilterOptions& options = {});

}  // namespace myoid::recording
