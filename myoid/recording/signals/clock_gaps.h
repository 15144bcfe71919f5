#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/stretch.h"

namespace myoid::recording {

/// Pauses of a clock: intervals longer than 2.5 times the median, where two or more samples are
/// missing. (Interpolation bridges a single missing sample well.)
struct ClockGaps {
  int count = 0;
  double total_s = 0.0;           ///< Sum over all gaps.
  double longest_begin_s = 0.0;   ///< Last sample before the longest gap.
  double longest_end_s = 0.0;     ///< First sample after the longest gap.
  double usual_interval_s = 0.0;  ///< Median of the intervals.

  [[nodiscard]] double longest_s() const { return longest_end_s - longest_begin_s; }
  /// Returns "2 gaps, 3.5 s in all, the longest from 10.2 to 13.2 s".
  [[nodiscard]] std::string text() const;
};

/// Returns the parts between pauses longer than `longest_gap_s`, in order; one if there is no such pause.
[[nodiscard]] std::vector<Stretch> clock_stretches(const Eigen::Ref<const Eigen::VectorXd>& time_s,
                                                   double longest_gap_s);

/// Finds the gaps of an increasing clock. A clock of fewer than three samples has none.
[[nodiscard]] ClockGaps find_clock_gaps(const Eigen::Ref<const Eigen::VectorXd>& time_s);

}  // namespace myoid::recording
