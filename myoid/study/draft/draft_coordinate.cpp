#include "myoid/study/draft/draft_coordinate.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <Eigen/Core>

#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/ground/core/time_series.h"
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

std::string coordinate_of_channels(const body::BodyModel& model,
                                   const std::vector<std::string>& coordinates,
                                   const std::vector<std::string>& channels) {
  std::string best;
  std::size_t most = 0;
  for (const std::string& name : coordinates) {
    std::size_t count = 0;
    for (const ChannelMuscles& pair : match_channels(channels, movers(model, name)))
      count += pair.muscles.empty() ? 0 : 1;
    if (count <= most) continue;
    most = count;
    best = name;
  }
  return best;
}

}  // namespace myoid::study
