#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace myoid::signals {

/// Where a clock pauses: intervals longer than 2.5 times the median one, that is two samples or
/// more that were not recorded. (A single one lost is bridged well by any interpolation.)
struct ClockGaps {
  int count = 0;
  double total_s = 0.0;           ///< Of all gaps.
  double longest_begin_s = 0.0;   ///< Last sample before the longest gap ...
  double longest_end_s = 0.0;     ///< ... and the first after it.
  double usual_interval_s = 0.0;  ///< Median of the intervals.

  [[nodiscard]] double longest_s() const { return longest_end_s - longest_begin_s; }
  /// "2 gaps, 3.5 s in all, the longest from 10.2 to 13.2 s".
  [[nodiscard]] std::string text() const;
};

/// A part of a clock, both ends included.
struct ClockStretch {
  double begin_s = 0.0;
  double end_s = 0.0;
};

/// The parts between pauses of more than `longest_gap_s`, in order; one if there is no such pause.
[[nodiscard]] std::vector<ClockStretch> clock_stretches(
    const Eigen::Ref<const Eigen::VectorXd>& time_s, double longest_gap_s);

/// `time_s` increases. No gap in fewer than three samples.
[[nodiscard]] ClockGaps find_clock_gaps(const Eigen::Ref<const Eigen::VectorXd>& time_s);

}  // namespace myoid::signals
