#include "myoid/body/model/path_stations.h"

#include <algorithm>

#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

bool is_active(const PathPoint& point, const BodyState& state) {
  constexpr double kSlack_rad = 1e-5;
  if (!point.condition) return true;
  const double q = state.q[point.condition->coordinate];
  return q >= point.condition->lower - kSlack_rad && q <= point.condition->upper + kSlack_rad;
}

}  // namespace

void place_points(const PosedPath& posed, PathWorkspace& workspace) {
  const auto& [model, path, state] = posed;
  workspace.stations.clear();
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const PathPoint& point = path.points[i];
    if (!is_active(point, state)) continue;
    PathStation s;
    s.body = point.body;
    s.p_B = point.p_BP;
    s.source = static_cast<int>(i);
    if (point.moving) {
      const PathPoint::Moving& moving = *point.moving;
      Vec3 p_F;
      for (std::size_t k = 0; k < 3; ++k) {
        const int index = moving.coordinates[k];
        double q = 0.0;
        if (index >= 0)
          q = std::clamp(state.q[index], model.coordinates[at(index)].lower, model.coordinates[at(index)].upper);
        p_F[static_cast<Eigen::Index>(k)] = evaluate(moving.location[k], q).value;
      }
      s.p_B = moving.X_BF * p_F;
    }
    s.p_G = state.X_GB[at(s.body)] * s.p_B;
    workspace.stations.push_back(s);
  }
}

StationRange station_range(const MusclePath& path, const PathWrap& wrap, const std::vector<PathStation>& stations) {
  const int count = static_cast<int>(path.points.size());
  const int from = wrap.range_start < 1 ? 0 : std::min(wrap.range_start, count) - 1;
  const int to = wrap.range_end < 1 ? count - 1 : std::min(wrap.range_end, count) - 1;
  StationRange range{-1, -1};
  for (std::size_t j = 0; j < stations.size(); ++j) {
    const int source = stations[j].source;
    if (source < from || source > to) continue;
    if (range.begin < 0) range.begin = static_cast<int>(j);
    range.end = static_cast<int>(j);
  }
  return range.begin < 0 ? StationRange{} : range;
}

double length_of(const std::vector<PathStation>& stations) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    length += stations[i].on_wrap_after ? stations[i].arc_after_m : (stations[i + 1].p_G - stations[i].p_G).norm();
  }
  return length;
}

void add_pair_moment(const BodyModel& model,
                     const BodyState& state,
                     BodyIndex a,
                     const Vec3& p_GA,
                     BodyIndex b,
                     const Vec3& p_GB,
                     const Vec3& u_G,
                     Eigen::VectorXd& arm) {
  // Follows both branches to their common body, and from there on only if the pair makes a moment;
  // joints are in tree order.
  const Vec3 along = p_GB - p_GA;
  const Vec3 moment = along.cross(u_G);
  for (bool is_couple = moment.norm() > 1e-12 * along.norm(); a != b || (is_couple && a != 0);) {
    if (a == b) {
      const Joint& joint = model.joints[at(model.joint_of_body[at(a)])];
      for (const int c : joint.coordinates) arm[c] -= state.H_w_G[at(c)].dot(moment);
      a = b = joint.parent;
      continue;
    }
    const bool up_b = model.joint_of_body[at(b)] > model.joint_of_body[at(a)];
    const BodyIndex body = up_b ? b : a;
    const Joint& joint = model.joints[at(model.joint_of_body[at(body)])];
    const Vec3 reach = (up_b ? p_GB : p_GA) - state.X_GB[at(body)].p;
    for (const int c : joint.coordinates) {
      const double rate = u_G.dot(state.H_v_G[at(c)] + state.H_w_G[at(c)].cross(reach));
      arm[c] -= up_b ? rate : -rate;
    }
    (up_b ? b : a) = joint.parent;
  }
}

const PathPoint* moving_point(const MusclePath& path, const PathStation& station) {
  if (station.source < 0) return nullptr;
  const PathPoint& point = path.points[at(station.source)];
  if (!point.moving) return nullptr;
  const auto& c = point.moving->coordinates;
  return std::any_of(c.begin(), c.end(), [](int coordinate) { return coordinate >= 0; }) ? &point : nullptr;
}

std::array<PathStation, 2> contact_stations(const WrapObject& object,
                                            int number,
                                            const Pose& X_GW,
                                            const Vec3& first_W,
                                            const Vec3& second_W,
                                            double arc_length_m) {
  PathStation first;
  first.body = object.body;
  first.wrap = number;
  first.p_B = object.X_BW * first_W;
  first.p_G = X_GW * first_W;
  PathStation second = first;
  second.p_B = object.X_BW * second_W;
  second.p_G = X_GW * second_W;
  first.on_wrap_after = true;
  first.arc_after_m = arc_length_m;
  return {first, second};
}

void insert_behind(std::vector<PathStation>& stations, int station, const std::array<PathStation, 2>& contact) {
  const auto where = stations.begin() + station + 1;
  stations.insert(stations.insert(where, contact[1]), contact[0]);
}

void add_moving_moments(const PosedPath& posed,
                        const PathStation& a,
                        const PathStation& b,
                        const Vec3& u,
                        bool beyond_range,
                        Eigen::VectorXd& arm) {
  const auto add = [&](const PathStation& s, double sign) {
    const PathPoint* point = moving_point(posed.path, s);
    if (point == nullptr) return;
    for_each_moving_rate(posed, *point, beyond_range,
                         [&](int coordinate, const Vec3& rate) { arm[coordinate] -= sign * u.dot(rate); });
  };
  add(b, 1.0);
  add(a, -1.0);
}

}  // namespace myoid::body
