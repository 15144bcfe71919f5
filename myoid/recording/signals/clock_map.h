#pragma once

#include <optional>
#include <string>

#include "myoid/ground/core/time_series.h"

namespace myoid::recording {

/// Relation of a file's clock to the study's clock. A sample that the file stamps t was taken at
///
///   t + offset + 1e-6 drift (t - pivot)
///
/// on the clock of the study. Offset and drift refer to the pivot, where their errors are
/// independent. The map describes instruments; the delay between EMG and force is not part of it.
struct ClockMap {
  double offset_s = 0.0;
  double drift_ppm = 0.0;
  double pivot_s = 0.0;               ///< On the clock of the file.
  std::optional<double> offset_sd_s;  ///< Standard deviation; empty if not stated.
  std::optional<double> drift_sd_ppm;

  [[nodiscard]] double study_time_s(double file_time_s) const {
    return file_time_s + offset_s + 1e-6 * drift_ppm * (file_time_s - pivot_s);
  }
  [[nodiscard]] double file_time_s(double study_time_s) const {
    return pivot_s + (study_time_s - pivot_s - offset_s) / (1.0 + 1e-6 * drift_ppm);
  }
};

/// Moves a series to the clock of the study. Throws InvalidInput unless the drift is within 20 %.
[[nodiscard]] TimeSeries on_study_clock(TimeSeries series, const ClockMap& clock);

/// Returns "+12.3 ± 0.6 ms, 48 ± 3 ppm".
[[nodiscard]] std::string to_string(const ClockMap& clock);

}  // namespace myoid::recording
