#include "myoid/study/draft/draft_coordinate.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include <Eigen/Core>

#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/label_match.h"
#include "myoid/study/draft/channel_muscles.h"

namespace myoid::study {
namespace {

constexpr std::array<std::string_view, 4> kUsual{"elbowflex", "elbow", "kneeangle", "ankleangle"};

std::size_t rank(const std::string& coordinate) {
  const std::string plain = plain_label(coordinate);
  const auto found =
      std::ranges::find_if(kUsual, [&](std::string_view word) { return plain.find(word) != std::string::npos; });
  return static_cast<std::size_t>(found - kUsual.begin());
}

/// Returns the name with the other side in it; empty if it states none.
std::string mirrored(std::string name) {
  constexpr std::array<std::array<std::string_view, 2>, 2> kSides{{{"right", "left"}, {"Right", "Left"}}};
  for (const auto& [right, left] : kSides) {
    for (const auto& [from, to] : {std::pair(right, left), std::pair(left, right)})
      if (const std::size_t at = name.find(from); at != std::string::npos) return name.replace(at, from.size(), to);
  }
  for (const auto& [from, to] :
       {std::pair("_r", 'l'), std::pair("_l", 'r'), std::pair("_R", 'L'), std::pair("_L", 'R')}) {
    if (!name.ends_with(from)) continue;
    name.back() = to;
    return name;
  }
  return "";
}

/// Counts the channels that have the name of a muscle that moves the coordinate.
std::size_t channels_of(const body::BodyModel& model,
                        const std::string& coordinate,
                        const std::vector<std::string>& channels) {
  return static_cast<std::size_t>(
      std::ranges::count_if(match_channels(channels, movers(model, coordinate)),
                            [](const ChannelMuscles& pair) { return !pair.muscles.empty(); }));
}

}  // namespace

std::vector<std::string> movers(const body::BodyModel& model, const std::string& coordinate) {
  const auto& c = model.coordinates[static_cast<std::size_t>(model.coordinate_index(coordinate))];
  const double low = std::max(c.lower, c.default_value - 1.5);
  const double high = std::min(c.upper, c.default_value + 1.5);
  constexpr Eigen::Index kPoses = 7;
  Eigen::MatrixXd q = model.default_q().transpose().replicate(kPoses, 1);
  for (Eigen::Index i = 0; i < kPoses; ++i)
    q(i, model.coordinate_index(coordinate)) = low + (high - low) * (static_cast<double>(i) + 0.5) / kPoses;
  std::vector<Channel> channels;
  for (const body::Coordinate& each : model.coordinates)
    channels.push_back({each.name, body::coordinate_unit(each, 0)});
  const Eigen::VectorXd clock = Eigen::VectorXd::LinSpaced(kPoses, 0.0, 6.0);
  const body::JointMotion motion = body::joint_motion(model, TimeSeries(clock, channels, q)).motion;
  const body::MuscleKinematics muscles = body::muscle_kinematics(model, motion);
  const TimeSeries& arms = muscles.moment_arm.at(coordinate);
  std::vector<std::string> names;
  for (Eigen::Index m = 0; m < arms.channel_count(); ++m) {
    if (arms.values().col(m).cwiseAbs().maxCoeff() > 1e-3)
      names.push_back(arms.channels()[static_cast<std::size_t>(m)].name);
  }
  return names;
}

bool is_usual(const std::string& coordinate) { return rank(coordinate) < kUsual.size(); }

std::vector<std::string> usual_first(std::vector<std::string> coordinates) {
  std::ranges::stable_sort(coordinates, [](const std::string& a, const std::string& b) { return rank(a) < rank(b); });
  return coordinates;
}

std::vector<std::string> moved_coordinates(const body::BodyModel& model,
                                           const std::vector<std::string>& coordinates,
                                           const std::vector<TimeSeries>& recorded) {
  constexpr double kLeast_rad = 5.0 * kDegree, kMost = 0.5;
  enum class Recorded { no, still, moves };
  std::map<std::string, Recorded> kept;
  for (const std::string& name : coordinates) {
    const body::Coordinate& c = model.coordinates[static_cast<std::size_t>(model.coordinate_index(name))];
    double least = c.default_value, greatest = c.default_value;
    bool any_sample = false, beyond = false;
    for (const TimeSeries& angles : recorded) {
      const auto column = angles.find(name);
      if (!column || angles.sample_count() == 0) continue;
      const Eigen::ArrayXd q = angles.values().col(*column).array();
      least = any_sample ? std::min(least, q.minCoeff()) : q.minCoeff();
      greatest = any_sample ? std::max(greatest, q.maxCoeff()) : q.maxCoeff();
      any_sample = true;
      const auto outside = static_cast<double>((q < c.lower || q > c.upper).count());
      beyond = beyond || outside > kMost * static_cast<double>(q.size());
    }
    if (c.clamped && beyond) continue;
    kept[name] = !any_sample ? Recorded::no : greatest - least < kLeast_rad ? Recorded::still : Recorded::moves;
  }
  const bool any = std::ranges::any_of(kept, [](const auto& one) { return one.second == Recorded::moves; });
  std::vector<std::string> names;
  for (const std::string& name : coordinates)
    if (kept.contains(name) && (!any || kept.at(name) == Recorded::moves)) names.push_back(name);
  return names;
}

CoordinateOfChannels coordinate_of_channels(const body::BodyModel& model,
                                            const std::vector<std::string>& coordinates,
                                            const std::vector<std::string>& channels) {
  constexpr std::size_t kEnough = 2;  // a muscle and its antagonist
  std::vector<std::size_t> counts;
  for (const std::string& name : coordinates) counts.push_back(channels_of(model, name, channels));
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (counts[i] == 0) continue;
    const auto rank_of = [&](std::size_t k) {
      return std::pair(is_usual(coordinates[k]) && counts[k] >= kEnough, counts[k]);
    };
    if (!best || rank_of(i) > rank_of(*best)) best = i;
  }
  CoordinateOfChannels chosen;
  if (!best) return chosen;
  chosen.name = coordinates[*best];
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    if (counts[i] > counts[*best]) chosen.more.push_back(coordinates[i]);
  return chosen;
}

std::string same_on_the_other_side(const body::BodyModel& model,
                                   const std::string& coordinate,
                                   const std::vector<std::string>& channels) {
  const std::string other = mirrored(coordinate);
  const auto found = std::ranges::find(model.coordinates, other, &body::Coordinate::name);
  if (found == model.coordinates.end() || found->locked) return "";
  const std::size_t count = channels_of(model, coordinate, channels);
  return count > 0 && channels_of(model, other, channels) >= count ? other : "";
}

}  // namespace myoid::study
