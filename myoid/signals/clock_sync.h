#pragma once

#include <string>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/signals/clock_map.h"

namespace myoid::signals {

/// Clocks of instruments are right within this, one standard deviation, before anything is
/// measured.
inline constexpr double kClockPrior_ppm = 100.0;

/// Instants and how well each of them is known.
struct Instants {
  std::vector<double> time_s;  ///< Increasing.
  double sd_s = 0.0;
};

/// When a channel rises through the middle between its lowest and its highest value (falls, with
/// `falling`), having been in its lower quarter since the last time. An edge lies anywhere between
/// two samples: sd = interval / sqrt(12). Empty for a channel that does not change.
[[nodiscard]] Instants trigger_edges(const TimeSeries& series,
                                     const std::string& channel,
                                     bool falling = false);

/// The file's clock from instants that both recordings hold: a straight line through their
/// differences, with a drift known beforehand to be 0 ± kClockPrior_ppm. Where one recording has
/// seen more of them, the others are found by the pattern of their intervals. Throws InvalidInput
/// where there is none, where no or more than one way to pair them fits within 5 standard
/// deviations, or where it takes a drift above 5 %.
[[nodiscard]] ClockMap match_instants(const Instants& file, const Instants& study);

/// The file's clock from a signal that both recordings hold (of one channel each, any units, sign
/// as it is): the shift of the largest correlation, within `search_s` either way, then of four to
/// sixteen parts of the recording by themselves, and a line through these as in `match_instants`.
/// The standard deviations are those of the parts about the line. Throws InvalidInput where fewer
/// than 4 s are common, the correlation is below 0.8, or another shift correlates nearly as well.
[[nodiscard]] ClockMap match_shape(const TimeSeries& file,
                                   const TimeSeries& study,
                                   double search_s);

}  // namespace myoid::signals
