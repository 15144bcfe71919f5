#pragma once

#include <optional>

#include <Eigen/Core>

namespace myoid::inline ground {

/// Start, duration and rate of a clock, as far as its samples define them. Without samples there is
/// no start, with one sample no rate. Readers may return empty series, so that descriptions of
/// series use this instead of the first and last time.
struct ClockFacts {
  Eigen::Index samples = 0;
  std::optional<double> start_s;     ///< Time of the first sample.
  std::optional<double> duration_s;  ///< From the first sample to the last.
  std::optional<double> rate_hz;     ///< (samples - 1) / duration; needs two samples.
  bool even = false;                 ///< No interval departs from the mean by more than 0.1 %.
};

/// Describes a clock. Values stay empty if times are not finite or the last time is not after the first.
[[nodiscard]] ClockFacts clock_facts(const Eigen::VectorXd& time_s);

}  // namespace myoid::inline ground
