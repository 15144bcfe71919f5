#include "myoid/recording/signals/motion_jumps.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "myoid/ground/core/units.h"

namespace myoid::recording {
namespace {

struct Jump {
  Eigen::Index at = 0;  ///< Interval of the greatest speed.
  int count = 0;
};

/// Returns the speed of a channel for each interval between samples.
Eigen::VectorXd speeds(const Eigen::VectorXd& time_s, const Eigen::VectorXd& x) {
  const Eigen::Index n = x.size() - 1;
  return (x.tail(n) - x.head(n)).cwiseQuotient(time_s.tail(n) - time_s.head(n)).cwiseAbs();
}

std::optional<Jump> find_jump(const Eigen::VectorXd& time_s,
                              const Eigen::VectorXd& speed,
                              double least,
                              const Stretch& within) {
  constexpr double kUsual = 0.95;
  std::vector<double> sorted(speed.begin(), speed.end());
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(kUsual * static_cast<double>(speed.size()));
  std::nth_element(sorted.begin(), at, sorted.end());
  const double usual = *at;
  const double limit = std::max(least, kJumpLimits.ratio * usual);
  std::optional<Jump> found;
  for (Eigen::Index i = 0; i < speed.size();) {
    if (!(speed[i] > limit)) {
      ++i;
      continue;
    }
    Eigen::Index peak = i, end = i;
    for (; end < speed.size() && speed[end] > limit; ++end) {
      if (speed[end] > speed[peak]) peak = end;
    }
    Eigen::Index first = peak, last = peak;
    while (first > 0 && speed[first - 1] > 0.5 * speed[peak]) --first;
    while (last + 1 < speed.size() && speed[last + 1] > 0.5 * speed[peak]) ++last;
    const bool inside = time_s[peak + 1] >= within.begin_s && time_s[peak] <= within.end_s;
    if (inside && time_s[last + 1] - time_s[first] < kJumpLimits.for_s) {
      if (!found) found = Jump{peak, 0};
      if (speed[peak] > speed[found->at]) found->at = peak;
      ++found->count;
    }
    i = std::max(end, last + 1);
  }
  return found;
}

}  // namespace

std::string MotionJump::sentence() const {
  return fmt::format(
      "'{}' moves at {} at {:.3f} s{}: no movement is so fast for so short a time, and its acceleration would mean a "
      "torque that does not exist; mend the markers or angles there, or leave that time out",
      channel, unit == Unit::radian ? fmt::format("{:.0f} deg/s", speed / kDegree) : fmt::format("{:.2g} m/s", speed),
      time_s, count > 1 ? fmt::format(" ({} such moments)", count) : "");
}

std::vector<MotionJump> find_motion_jumps(const TimeSeries& motion, const Stretch& within) {
  constexpr Eigen::Index kLeastSamples = 20;
  std::vector<MotionJump> jumps;
  if (motion.sample_count() < kLeastSamples) return jumps;
  const Eigen::VectorXd& t = motion.time_s();
  for (Eigen::Index c = 0; c < motion.channel_count(); ++c) {
    const Channel& channel = motion.channels()[static_cast<std::size_t>(c)];
    const bool angle = channel.unit == Unit::radian;
    const Eigen::VectorXd x = motion.values().col(c);
    if ((!angle && channel.unit != Unit::meter) || !x.allFinite()) continue;
    const Eigen::VectorXd speed = speeds(t, x);
    if (const auto jump = find_jump(t, speed, angle ? kJumpLimits.radps : kJumpLimits.mps, within))
      jumps.push_back({channel.name, channel.unit, t[jump->at], speed[jump->at], jump->count});
  }
  return jumps;
}

}  // namespace myoid::recording
