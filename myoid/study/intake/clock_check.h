#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/error.h"
#include "myoid/recording/signals/clock_gaps.h"
#include "myoid/study/intake/limits.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Longest bridged pause of a clock: a spline across a longer one would invent data.
inline constexpr double kLongestGap_s = kLimits.clocks.pause_s;

/// Reports a clock with a pause of more than kLongestGap_s.
class ClockPause : public ReadError {
 public:
  ClockPause(const std::filesystem::path& path, const std::string& message, std::vector<Stretch> stretches)
      : ReadError(path, 0, message), stretches_(std::move(stretches)) {}
  /// Returns the parts of the clock between the pauses.
  [[nodiscard]] const std::vector<Stretch>& stretches() const { return stretches_; }

 private:
  std::vector<Stretch> stretches_;
};

/// Returns a warning about the shorter pauses of a file's clock, empty if there are none. Throws
/// ReadError for a clock too slow for human movement (less than 5 Hz: milliseconds or frames), and
/// ClockPause for a pause of more than kLongestGap_s.
[[nodiscard]] std::string check_clock(const std::filesystem::path& path, const Eigen::VectorXd& time_s);

/// Throws ReadError if [motion] cutoff_hz is at least 0.45 of the rate of this file's clock.
void check_cutoff(const Study& study, const std::filesystem::path& path, const Eigen::VectorXd& time_s);

}  // namespace myoid::study
