#pragma once

#include <optional>
#include <string>

#include "myoid/core/time_series.h"

namespace myoid::signals {

/// How the clock of one file stands to that of the study. A sample that the file stamps t was taken
/// at
///
///   t + offset + 1e-6 drift (t - pivot)
///
/// on the clock of the study. Offset and drift are about the pivot, where their errors are
/// independent. This is a matter of instruments: the delay between EMG and force is not in it.
struct ClockMap {
  double offset_s = 0.0;
  double drift_ppm = 0.0;
  double pivot_s = 0.0;               ///< On the clock of the file.
  std::optional<double> offset_sd_s;  ///< Standard deviation; empty: not stated.
  std::optional<double> drift_sd_ppm;

  [[nodiscard]] double study_time_s(double file_time_s) const {
    return file_time_s + offset_s + 1e-6 * drift_ppm * (file_time_s - pivot_s);
  }
  [[nodiscard]] double file_time_s(double study_time_s) const {
    return pivot_s + (study_time_s - pivot_s - offset_s) / (1.0 + 1e-6 * drift_ppm);
  }
};

/// The same samples on the clock of the study. Throws InvalidInput unless the drift lies within 20
/// %.
[[nodiscard]] TimeSeries on_study_clock(TimeSeries series, const ClockMap& clock);

/// "+12.3 ± 0.6 ms, 48 ± 3 ppm".
[[nodiscard]] std::string to_string(const ClockMap& clock);

}  // namespace myoid::signals
