#include "myoid/recording/signals/clock_map.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::recording {

TimeSeries on_study_clock(TimeSeries series, const ClockMap& clock) {
  constexpr double kMost_ppm = 2e5;
  if (!(std::abs(clock.drift_ppm) < kMost_ppm)) {
    throw InvalidInput("clock: a drift of {} ppm; expected less than {}", clock.drift_ppm, kMost_ppm);
  }
  Eigen::VectorXd time_s = series.time_s();
  for (double& t : time_s) t = clock.study_time_s(t);
  return {std::move(time_s), series.channels(), series.values()};
}

std::string to_string(const ClockMap& clock) {
  std::string text = fmt::format("{:+.1f}", 1e3 * clock.offset_s);
  if (clock.offset_sd_s) {
    const double sd_ms = 1e3 * *clock.offset_sd_s;
    text += sd_ms < 99.5 ? fmt::format(" ± {:.2g}", sd_ms) : fmt::format(" ± {:.0f}", sd_ms);
  }
  text += " ms";
  if (clock.drift_ppm == 0.0 && !clock.drift_sd_ppm) return text;
  text += fmt::format(", {:.0f}", clock.drift_ppm);
  if (clock.drift_sd_ppm) text += fmt::format(" ± {:.2g}", *clock.drift_sd_ppm);
  return text + " ppm";
}

}  // namespace myoid::recording
