#pragma once

#include <optional>

#include <Eigen/Core>

namespace myoid {

/// Start, duration and rate of a clock, as far as its samples tell them: no samples have no start,
/// and one sample has no rate. Every reader of files may return an empty series, so whoever
/// describes a series asks here and not the first and last of its times.
struct ClockFacts {
  Eigen::Index samples = 0;
  std::optional<double> start_s;     ///< Time of the first sample.
  std::optional<double> duration_s;  ///< From the first sample to the last.
  std::optional<double> rate_hz;     ///< (samples - 1) / duration; needs two samples.
  bool even = false;                 ///< No interval departs from the mean by more than 0.1 %.
};

/// Describes a clock. Times that are not finite, or a last time that is not behind the first, leave
/// empty what cannot be computed of them.
[[nodiscard]] ClockFacts clock_facts(const Eigen::VectorXd& time_s);

}  // namespace myoid
