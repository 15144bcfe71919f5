#pragma once

#include <string>
#include <vector>

#include "myoid/ground/core/time_series.h"
#include "myoid/recording/signals/clock_map.h"

namespace myoid::recording {

/// Prior standard deviation of an instrument clock's drift.
inline constexpr double kClockPrior_ppm = 100.0;

/// Instants and the standard deviation of each.
struct Instants {
  std::vector<double> time_s;  ///< Increasing.
  double sd_s = 0.0;
};

/// Returns the times at which a channel rises (falls, with `falling`) through the middle of its
/// range, after a visit to the quarter of the range where the edge starts. An edge lies anywhere
/// between two samples: sd = interval / sqrt(12). Empty for a channel that does not change.
[[nodiscard]] Instants trigger_edges(const TimeSeries& series, const std::string& channel, bool falling = false);

/// Finds the file's clock from instants that both recordings hold: a straight line through their
/// differences, with the drift's prior 0 ± kClockPrior_ppm. If one recording has more instants, the
/// pattern of intervals finds the common ones. Throws InvalidInput if there are no instants, if
/// none or several ways to pair them fit within 5 standard deviations, or if the drift exceeds 5 %.
[[nodiscard]] ClockMap match_instants(const Instants& file, const Instants& study);

/// Finds the file's clock from a signal that both recordings hold (one channel each, any units, equal sign). The shift
/// with the largest correlation within `search_s` to either side is refined for four to sixteen parts of the recording,
/// and a line as in `match_instants` goes through these. The standard deviations come from the scatter of the parts
/// about the line. Throws InvalidInput if less than 4 s are common, the correlation is below 0.8, or another shift
/// correlates nearly as well.
[[nodiscard]] ClockMap match_shape(const TimeSeries& file, const TimeSeries& study, double search_s);

}  // namespace myoid::recording
