#include "myoid/study/intake/clock_check.h"

#include <fmt/format.h>

#include "myoid/body/kinematics/motion_plausibility.h"
#include "myoid/study/intake/limits.h"

namespace myoid::study {

std::string check_clock(const std::filesystem::path& path, const Eigen::VectorXd& time_s) {
  if (const std::string slow = body::slow_clock(time_s); !slow.empty()) throw ReadError(path, 0, slow);
  const recording::ClockGaps gaps = recording::find_clock_gaps(time_s);
  if (gaps.longest_s() > kLongestGap_s) {
    throw ClockPause(path,
                     fmt::format("{} in its clock; a pause of more than {} s cannot be bridged: make two trials of it, "
                                 "with end_s before and start_s after the gap",
                                 gaps.text(), kLongestGap_s),
                     recording::clock_stretches(time_s, kLongestGap_s));
  }
  if (gaps.count == 0) return "";
  return fmt::format("{}: {} in its clock, bridged by a spline", path.filename().string(), gaps.text());
}

void check_cutoff(const Study& study, const std::filesystem::path& path, const Eigen::VectorXd& time_s) {
  if (study.motion.smoothing != Smoothing::cutoff) return;
  const Eigen::Index n = time_s.size();
  const double rate_hz = static_cast<double>(n - 1) / (time_s[n - 1] - time_s[0]);
  if (study.motion.cutoff_hz < 0.45 * rate_hz) return;
  throw ReadError(path, 0,
                  fmt::format("[motion] cutoff_hz = {}, but this file has {:.4g} Hz; expected less than 0.45 of that",
                              study.motion.cutoff_hz, rate_hz));
}

}  // namespace myoid::study
