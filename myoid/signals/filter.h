#pragma once

#include "myoid/core/time_series.h"
#include "myoid/math/butterworth.h"
#include "myoid/math/zero_phase.h"

namespace myoid::signals {

struct FilterOptions {
  int order = 2;          ///< Of one pass.
  bool corrected = true;  ///< -3 dB of the two passes together at the cut-off; false: of one pass,
                          ///< as the source paper.
  math::Ends ends = math::Ends::odd;  ///< `even` for EMG, raw or rectified.
};

/// Every channel filtered forwards and backwards by a Butterworth filter: no delay. The clock must
/// be even. Throws InvalidInput if it is not, if a value is not finite, or the cut-off does not lie
/// below half the rate.
[[nodiscard]] TimeSeries zero_phase_filter(const TimeSeries& series,
                                           math::FilterBand band,
                                           double cutoff_hz,
                                           const FilterOptions& options = {});

}  // namespace myoid::signals
