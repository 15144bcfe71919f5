#include "myoid/body/kinematics/motion_plausibility.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/kinematics/people_range.h"
#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/units.h"
#include "myoid/recording/signals/clock_gaps.h"
#include "myoid/recording/signals/motion_jumps.h"

namespace myoid::body {
namespace {

constexpr Eigen::Index kLeastSamples = 10;

std::optional<Remark> doubtful_clock(const TimeSeries& motion) {
  const Eigen::VectorXd& t = motion.time_s();
  Remark remark{.code = RemarkCode::motion_impossible, .severity = Severity::error, .about = "clock"};
  remark.says = slow_clock(t);
  if (!remark.says.empty()) return remark;
  if (t.size() < kLeastSamples) return std::nullopt;
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

std::string whole_degrees(double angle_rad) { return fmt::format("{:.0f}", angle_rad / kDegree); }

/// The angles that a coordinate may have, with a margin.
struct AngleRange {
  double lower_rad = 0.0, upper_rad = 0.0;
  bool of_people = false;  ///< Narrower than the model's.

  [[nodiscard]] bool holds(double low_rad, double high_rad) const {
    return low_rad >= lower_rad && high_rad <= upper_rad;
  }
};

/// Returns the model's range or, where that reaches beyond people's at both ends and so tells no convention, people's.
AngleRange angle_range(const Coordinate& c) {
  const auto people = people_range(c.name, c.lower, c.upper);
  if (people && c.lower < people->low_rad && people->high_rad < c.upper)
    return {people->low_rad, people->high_rad, true};
  return {c.lower - kMotionLimits.beyond_rad, c.upper + kMotionLimits.beyond_rad};
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
  if (time_s.size() < kLeastSamples || !(interval_s > 1.0 / kMotionLimits.slowest_hz)) return {};
  return fmt::format(
      "{} samples from {:.6g} to {:.6g}, about one per {:.3g} s: is the time in ms or in frames? expected seconds and "
      "{} Hz or more",
      time_s.size(), time_s[0], time_s[time_s.size() - 1], interval_s, kMotionLimits.slowest_hz);
}

std::optional<Remark> angle_outside_range(const Coordinate& c, const Eigen::Ref<const Eigen::VectorXd>& angle_rad) {
  constexpr double kBeyond_rad = kMotionLimits.beyond_rad;
  if (c.motion == MotionType::translational || !(c.upper - c.lower > kBeyond_rad)) return std::nullopt;
  const AngleRange range = angle_range(c);
  const double lower = range.lower_rad, upper = range.upper_rad;
  const double least = angle_rad.minCoeff(), greatest = angle_rad.maxCoeff();
  const auto outside = (angle_rad.array() < lower || angle_rad.array() > upper).count();
  if (outside == 0) return std::nullopt;
  const double share = static_cast<double>(outside) / static_cast<double>(angle_rad.size());
  if (range.of_people && share < kMotionLimits.beyond_people_share) return std::nullopt;
  // The farther end of the margin is the range's.
  const double far = std::max(lower - least, greatest - upper) + kBeyond_rad;
  // A coordinate that is outside most of the time follows another convention.
  const bool wrong = share > kMotionLimits.outside_share && c.clamped && !range.of_people;
  const bool negated = range.holds(-greatest, -least);
  return Remark{
      .code = RemarkCode::angle_outside_range,
      .severity = wrong ? Severity::error : Severity::warning,
      .about = c.name,
      .says = fmt::format(
          "{} goes from {} to {} deg, but {} {} to {} deg{}: {} of the samples lie outside, by up to {} deg{}; {}",
          c.name, whole_degrees(least), whole_degrees(greatest),
          range.of_people ? "people's joints reach" : "the model's range is", whole_degrees(lower + kBeyond_rad),
          whole_degrees(upper - kBeyond_rad), c.clamped || range.of_people ? "" : " (not clamped)",
          share < 0.005 ? std::string("less than 1 %") : fmt::format("{:.0f} %", 100.0 * share), whole_degrees(far),
          range.of_people ? "" : ", where its muscle paths mean nothing",
          negated ? "is its sign the opposite of the model's?" : "is its zero or sign another than the model's?"),
      .remedy = wrong ? "turn or shift the angles, take a model of the same convention, or draft another joint "
                        "(myoid init --coordinate)"
                      : ""};
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
  for (const std::string& name : coordinates) {
    const Coordinate& c = model.coordinates[static_cast<std::size_t>(*model.find_coordinate(name))];
    if (!people_range(name, c.lower, c.upper)) continue;  // angles of a shoulder have many conventions
    auto outside = angle_outside_range(c, motion.column(name));
    if (outside && outside->severity == Severity::error) found.push_back(*std::move(outside));
  }
  if (auto absent = absent_coordinates(model, motion, needed)) found.push_back(std::move(*absent));
  return found;
}

}  // namespace myoid::body
