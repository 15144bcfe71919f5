#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/time_series.h"

namespace myoid::recording {

/// A stretch in which a muscle is active.
struct EmgBurst {
  double onset_s = 0.0, end_s = 0.0;
};

/// Returns when a channel of filtered EMG rises above its rest: the rectified signal, low-passed at 25 Hz without
/// delay, above mean + 5 standard deviations of the quietest second (Hodges & Bui 1996). Bursts shorter than 0.05 s
/// are none; pauses shorter than 0.1 s belong to the burst. Empty if the channel never does. `filtered` is one channel
/// without offset.
[[nodiscard]] std::vector<EmgBurst> emg_bursts(const TimeSeries& filtered, Eigen::Index channel);

/// Root mean square and median frequency over one stretch of a channel.
struct EmgWindow {
  double begin_s = 0.0, end_s = 0.0;
  double rms = 0.0;                  ///< In the unit of the EMG.
  double median_frequency_hz = 0.0;  ///< From 20 to 400 Hz; NaN without power there, or below 8 samples.
};

/// Returns one stretch's numbers.
[[nodiscard]] EmgWindow emg_window(const TimeSeries& filtered, Eigen::Index channel, double begin_s, double end_s);

/// Returns the numbers of successive windows of this length. An incomplete last window is left out.
[[nodiscard]] std::vector<EmgWindow> emg_windows(const TimeSeries& filtered, Eigen::Index channel, double window_s);

}  // namespace myoid::recording
