#include "myoid/recording/signals/clock_gaps.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/ground/math/statistics.h"

namespace myoid::recording {

ClockGaps find_clock_gaps(const Eigen::Ref<const Eigen::VectorXd>& time_s) {
  ClockGaps gaps;
  const Eigen::Index n = time_s.size();
  if (n < 3) return gaps;
  const Eigen::VectorXd intervals = time_s.tail(n - 1) - time_s.head(n - 1);
  gaps.usual_interval_s = math::upper_median({intervals.begin(), intervals.end()});
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    if (intervals[i] <= 2.5 * gaps.usual_interval_s) continue;
    ++gaps.count;
    gaps.total_s += intervals[i];
    if (intervals[i] > gaps.longest_s()) {
      gaps.longest_begin_s = time_s[i];
      gaps.longest_end_s = time_s[i + 1];
    }
  }
  return gaps;
}

std::vector<Stretch> clock_stretches(const Eigen::Ref<const Eigen::VectorXd>& time_s, double longest_gap_s) {
  std::vector<Stretch> stretches;
  for (Eigen::Index i = 0; i < time_s.size(); ++i) {
    if (i == 0 || time_s[i] - time_s[i - 1] > longest_gap_s) stretches.push_back({time_s[i], time_s[i]});
    stretches.back().end_s = time_s[i];
  }
  return stretches;
}

std::string ClockGaps::text() const {
  if (count == 0) return "no gap";
  // To the millisecond, also on a clock that counts from 1970.
  const int digits = std::max(6, 4 + static_cast<int>(std::log10(std::max(std::abs(longest_end_s), 1.0))));
  const std::string longest = fmt::format("from {:.{}g} to {:.{}g} s", longest_begin_s, digits, longest_end_s, digits);
  if (count == 1) return "a gap " + longest;
  return fmt::format("{} gaps, {:.3g} s in all, the longest {}", count, total_s, longest);
}

}  // namespace myoid::recording
