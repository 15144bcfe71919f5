#include "myoid/body/kinematics/open_coordinates.h"

#include <algorithm>
#include <set>

namespace myoid::body {
namespace {

/// Returns the first, the middle and the last frame of those that show most markers of the model.
std::set<Eigen::Index> fullest_frames(const body::BodyModel& model, const MarkerSeries& markers) {
  std::vector<Eigen::Index> fullest;
  Eigen::Index most = -1;
  for (Eigen::Index i = 0; i < markers.frame_count(); ++i) {
    Eigen::Index seen = 0;
    for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
      if (model.find_marker(markers.names[static_cast<std::size_t>(m)]) && !markers.missing(i, m)) ++seen;
    }
    if (seen > most) fullest.clear();
    most = std::max(most, seen);
    if (seen == most) fullest.push_back(i);
  }
  if (fullest.empty()) return {};
  return {fullest.front(), fullest[fullest.size() / 2], fullest.back()};
}

/// Returns the model with another default posture, in which no limb is straight.
body::BodyModel bent(body::BodyModel model) {
  double turn_rad = 0.3;
  for (body::Coordinate& c : model.coordinates) {
    if (c.locked || c.motion != body::MotionType::rotational) continue;
    const double up = c.default_value + turn_rad, down = c.default_value - turn_rad;
    c.default_value = !c.clamped || up <= c.upper ? up : std::max(down, c.lower);
    turn_rad += 0.03;
  }
  return model;
}

}  // namespace

std::vector<std::string> open_coordinates(const body::BodyModel& model,
                                          const MarkerSeries& markers,
                                          const IkOptions& options) {
  std::vector<std::string> open;
  bool first = true;
  for (const Eigen::Index frame : fullest_frames(model, markers)) {
    const std::vector<std::string> here =
        inverse_kinematics(
            model,
            MarkerSeries{markers.time_s.segment(frame, 1), markers.names, markers.positions_m.middleRows(frame, 1)},
            options)
            .open_coordinates;
    if (first) open = here;
    std::erase_if(open, [&](const std::string& name) { return std::ranges::find(here, name) == here.end(); });
    first = false;
  }
  if (open.empty()) return open;
  // A straight limb, as one that reaches for markers too far away, is open in that posture alone.
  IkOptions posed = options;
  posed.max_iterations = 0;
  const Eigen::Index frame = *fullest_frames(model, markers).begin();
  const std::vector<std::string> always =
      inverse_kinematics(
          bent(model),
          MarkerSeries{markers.time_s.segment(frame, 1), markers.names, markers.positions_m.middleRows(frame, 1)},
          posed)
          .open_coordinates;
  std::erase_if(open, [&](const std::string& name) { return std::ranges::find(always, name) == always.end(); });
  return open;
}

}  // namespace myoid::body
