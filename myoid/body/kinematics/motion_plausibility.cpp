#include "myoid/body/kinematics/motion_plausibility.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/units.h"
#include "myoid/recording/signals/clock_gaps.h"
#include "myoid/recording/signals/motion_jumps.h"

namespace myoid::body {
namespace {

constexpr Eigen::Index kLeastSamples = 10;

std::optional<Remark> doubtful_clock(const TimeSeries& motion) {
  const Eigen::VectorXd& t = motion.time_s();
  if (t.size() < kLeastSamples) return std::nullopt;
  Remark remark{.code = RemarkCode::motion_impossible, .severity = Severity::error, .about = "clock"};
  remark.says = slow_clock(t);
  if (!remark.says.empty()) return remark;
  const double rate_hz = motion.mean_rate_hz();
  if (rate_hz <= kMotionLimits.fastest_hz) return std::nullopt;
  remark.value = rate_hz;
  remark.says = fmt::format("{} samples from {:.6g} to {:.6g} s, {:.3g} a second: is the time in another unit than s?",
                            t.size(), t[0], t[t.size() - 1], rate_hz);
  remark.remedy = "write the time in s";
  return remark;
}

/// Returns the speed that a channel exceeds in kMotionLimits.share of the intervals within the stretch.
double usual_speed(const Eigen::VectorXd& t, const Eigen::Ref<const Eigen::VectorXd>& x, const Stretch& within) {
  std::vector<double> speeds;
  for (Eigen::Index i = 0; i + 1 < t.size(); ++i) {
    const double speed = std::abs(x[i + 1] - x[i]) / (t[i + 1] - t[i]);
    if (std::isfinite(speed) && t[i] >= within.begin_s && t[i + 1] <= within.end_s) speeds.push_back(speed);
  }
  if (std::ssize(speeds) < kLeastSamples) return 0.0;
  const auto at = speeds.begin() +
                  static_cast<std::ptrdiff_t>((1.0 - kMotionLimits.share) * static_cast<double>(speeds.size() - 1));
  std::nth_element(speeds.begin(), at, speeds.end());
  return *at;
}

std::optional<Remark> too_fast(const TimeSeries& motion, const Stretch& within) {
  std::optional<Remark> found;
  double worst = 1.0;  // speed over the limit of its unit
  std::size_t count = 0;
  for (Eigen::Index c = 0; c < motion.channel_count(); ++c) {
    const Channel& channel = motion.channels()[static_cast<std::size_t>(c)];
    const bool angle = channel.unit == Unit::radian;
    if (!angle && channel.unit != Unit::meter) continue;
    const double speed = usual_speed(motion.time_s(), motion.values().col(c), within);
    const double over = speed / (angle ? kMotionLimits.fastest_radps : kMotionLimits.fastest_mps);
    if (over > 1.0) ++count;
    if (over <= worst) continue;
    worst = over;
    found = Remark{
        .code = RemarkCode::motion_impossible,
        .severity = Severity::error,
        .about = channel.name,
        .value = speed,
        .says = fmt::format("'{}' moves faster than {} in {:.0f} % of the time: nobody does", channel.name,
                            angle ? fmt::format("{:.4g} deg/s", speed / kDegree) : fmt::format("{:.4g} m/s", speed),
                            100.0 * kMotionLimits.share),
        .remedy = "correct the clock, which may be in another unit than s, or the unit of the values"};
  }
  if (found && count > 1) found->says += fmt::format(" ({} columns are so fast)", count);
  return found;
}

std::optional<Remark> absent_coordinates(const body::BodyModel& model,
                                         const TimeSeries& motion,
                                         const std::vector<std::string>& needed) {
  std::vector<std::string> resting;
  std::string first;
  for (const body::Coordinate& coordinate : model.coordinates) {
    if (coordinate.locked || motion.find(coordinate.name)) continue;
    if (!needed.empty() && std::ranges::find(needed, coordinate.name) == needed.end()) continue;
    if (first.empty()) first = coordinate.name;
    resting.push_back(coordinate.default_value == 0.0
                          ? coordinate.name
                          : fmt::format("{} at {:.4g} {}", coordinate.name, coordinate.default_value,
                                        symbol(coordinate_unit(coordinate, 0))));
  }
  if (resting.empty()) return std::nullopt;
  return Remark{.code = RemarkCode::coordinate_absent,
                .about = resting.size() > 1 ? fmt::format("{} and {} more", first, resting.size() - 1) : first,
                .value = static_cast<double>(resting.size()),
                .says = fmt::format("{} not in the motion, held at 0 or as said: {}",
                                    counted(resting.size(), "coordinate"), fmt::join(resting, ", "))};
}

}  // namespace

std::string slow_clock(const Eigen::Ref<const Eigen::VectorXd>& time_s) {
  const double interval_s = recording::find_clock_gaps(time_s).usual_interval_s;
  if (!(interval_s > 1.0 / kMotionLimits.slowest_hz)) return {};
  return fmt::format(
      "{} samples from {:.6g} to {:.6g}, about one per {:.3g} s: is the time in ms or in frames? expected seconds and "
      "{} Hz or more",
      time_s.size(), time_s[0], time_s[time_s.size() - 1], interval_s, kMotionLimits.slowest_hz);
}

std::vector<Remark> implausible_motion(const TimeSeries& motion, const Stretch& within) {
  std::vector<Remark> found;
  if (auto clock = doubtful_clock(motion)) found.push_back(std::move(*clock));
  if (auto fast = too_fast(motion, within)) found.push_back(std::move(*fast));
  // A jump says nothing more where every speed is impossible.
  if (!found.empty()) return found;
  for (const recording::MotionJump& jump : recording::find_motion_jumps(motion, within))
    found.push_back(
        {.code = RemarkCode::angle_jump, .about = jump.channel, .value = jump.speed, .says = jump.sentence()});
  return found;
}

std::vector<Remark> implausible_motion(const body::BodyModel& model,
                                       const TimeSeries& motion,
                                       const Stretch& within,
                                       const std::vector<std::string>& needed) {
  std::vector<std::string> coordinates;
  for (const Channel& channel : motion.channels()) {
    if (model.find_coordinate(channel.name)) coordinates.push_back(channel.name);
  }
  std::vector<Remark> found = implausible_motion(motion.select(coordinates), within);
  if (auto absent = absent_coordinates(model, motion, needed)) found.push_back(std::move(*absent));
  return found;
}

}  // namespace myoid::body
