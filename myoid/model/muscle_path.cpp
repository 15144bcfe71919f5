#include "myoid/model/muscle_path.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "myoid/model/wrap_cylinder.h"
#include "myoid/model/wrap_ellipsoid.h"

namespace myoid::model {
namespace {

/// A point the path runs through at this posture.
struct Station {
  BodyIndex body = 0;
  Vec3 p_B = Vec3::Zero();
  Vec3 p_G = Vec3::Zero();
  int source = -1;  ///< Number in the muscle's points, or -1 for a tangent point.
  int wrap = -1;    ///< Number in the muscle's wraps for a tangent point.
  double arc_after_m =
      0.0;  ///< Length on the wrap object from here to the next station; the piece is not straight.
  bool on_wrap_after = false;
};

Station station_of(const BodyModel& model,
                   const PathPoint& point,
                   int number,
                   const BodyState& state) {
  Station s;
  s.body = point.body;
  s.p_B = point.p_BP;
  s.source = number;
  if (point.moving) {
    const PathPoint::Moving& moving = *point.moving;
    double q = 0.0;
    if (moving.coordinate >= 0) {
      const Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(moving.coordinate)];
      q = std::clamp(state.q[moving.coordinate], coordinate.lower, coordinate.upper);
    }
    for (std::size_t k = 0; k < 3; ++k)
      s.p_B[static_cast<Eigen::Index>(k)] = evaluate(moving.location[k], q).value;
  }
  s.p_G = state.X_GB[static_cast<std::size_t>(s.body)] * s.p_B;
  return s;
}

bool is_active(const PathPoint& point, const BodyState& state) {
  constexpr double kSlack_rad = 1e-5;
  if (!point.condition) return true;
  const double q = state.q[point.condition->coordinate];
  return q >= point.condition->lower - kSlack_rad && q <= point.condition->upper + kSlack_rad;
}

/// Puts the contact of one wrap, if there is any, where it obstructs the path.
void insert_wrap(const BodyModel& model,
                 const PathWrap& wrap,
                 int number,
                 const BodyState& state,
                 std::vector<Station>& stations) {
  const WrapObject& object = model.wrap_objects[static_cast<std::size_t>(wrap.wrap_object)];
  if (!object.active) return;
  const auto* cylinder = std::get_if<CylinderShape>(&object.shape);
  const auto* ellipsoid = std::get_if<EllipsoidShape>(&object.shape);
  const Pose X_GW = state.X_GB[static_cast<std::size_t>(object.body)] * object.X_BW;
  const Pose X_WG = X_GW.inverse();
  std::size_t best = stations.size();
  double best_change = std::numeric_limits<double>::infinity();
  WrapContact best_contact;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    if (stations[i].on_wrap_after) continue;
    const auto in_range = [&](const Station& s) {
      if (s.source < 0) return true;
      return (wrap.range_start < 1 || s.source + 1 >= wrap.range_start) &&
             (wrap.range_end < 1 || s.source + 1 <= wrap.range_end);
    };
    if (!in_range(stations[i]) || !in_range(stations[i + 1])) continue;
    const Vec3 p_W = X_WG * stations[i].p_G;
    const Vec3 q_W = X_WG * stations[i + 1].p_G;
    const auto contact = cylinder != nullptr
                             ? wrap_cylinder(*cylinder, object.quadrant, p_W, q_W)
                             : wrap_ellipsoid(*ellipsoid, object.quadrant, wrap.method, p_W, q_W);
    if (!contact) continue;
    const double change = (contact->first_W - p_W).norm() + contact->arc_length_m +
                          (q_W - contact->second_W).norm() - (q_W - p_W).norm();
    if (change < best_change) {
      best_change = change;
      best = i;
      best_contact = *contact;
    }
    if (ellipsoid != nullptr) break;  // the first piece that cuts an ellipsoid takes it
  }
  if (best == stations.size()) return;
  const auto tangent = [&](const Vec3& p_W) {
    Station s;
    s.body = object.body;
    s.p_B = object.X_BW * p_W;
    s.p_G = X_GW * p_W;
    s.wrap = number;
    return s;
  };
  Station first = tangent(best_contact.first_W);
  first.on_wrap_after = true;
  first.arc_after_m = best_contact.arc_length_m;
  const auto where = stations.begin() + static_cast<std::ptrdiff_t>(best) + 1;
  stations.insert(where, {first, tangent(best_contact.second_W)});
}

double total_length(const std::vector<Station>& stations) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    length += stations[i].on_wrap_after ? stations[i].arc_after_m
                                        : (stations[i + 1].p_G - stations[i].p_G).norm();
  }
  return length;
}

/// Derivative of a moving point's location by its coordinate, in ground.
Vec3 moving_rate(const BodyModel& model, const PathPoint& point, const BodyState& state) {
  const PathPoint::Moving& moving = *point.moving;
  if (moving.coordinate < 0) return Vec3::Zero();
  const Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(moving.coordinate)];
  const double q = state.q[moving.coordinate];
  if (q < coordinate.lower || q > coordinate.upper) return Vec3::Zero();
  Vec3 rate;
  for (std::size_t k = 0; k < 3; ++k)
    rate[static_cast<Eigen::Index>(k)] = evaluate(moving.location[k], q).first;
  return state.X_GB[static_cast<std::size_t>(point.body)].R * rate;
}

}  // namespace

PathResult compute_path(const BodyModel& model, int muscle, const BodyState& state) {
  const MusclePath& path = model.muscles[static_cast<std::size_t>(muscle)].path;
  std::vector<Station> stations;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    if (is_active(path.points[i], state))
      stations.push_back(station_of(model, path.points[i], static_cast<int>(i), state));
  }
  PathResult result;
  if (!path.wraps.empty()) {
    // Each object in turn against its neighbours as they stand, until the length settles.
    double last = std::numeric_limits<double>::infinity();
    const int passes = path.wraps.size() == 1 ? 1 : 60;
    for (int pass = 0; pass < passes; ++pass) {
      for (std::size_t w = 0; w < path.wraps.size(); ++w) {
        const int number = static_cast<int>(w);
        std::erase_if(stations, [number](const Station& s) { return s.wrap == number; });
        insert_wrap(model, path.wraps[w], number, state, stations);
      }
      const double length = total_length(stations);
      if (std::abs(length - last) < 1e-13) break;
      last = length;
    }
  }
  for (const Station& s : stations) result.wrapped = result.wrapped || s.wrap >= 0;
  result.length_m = total_length(stations);
  const auto count = static_cast<Eigen::Index>(model.coordinates.size());
  result.moment_arm_m = Eigen::VectorXd::Zero(count);
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    if (stations[i].on_wrap_after) continue;
    const Station& a = stations[i];
    const Station& b = stations[i + 1];
    const Vec3 along = b.p_G - a.p_G;
    const double length = along.norm();
    if (!(length > 0.0)) continue;
    const Vec3 u = along / length;
    // A piece within one body changes only by the points' own motion in it.
    if (a.body != b.body) {
      result.moment_arm_m.noalias() -= (station_jacobian(model, state, b.body, b.p_B) -
                                        station_jacobian(model, state, a.body, a.p_B))
                                           .transpose() *
                                       u;
    }
    const auto add_moving = [&](const Station& s, double sign) {
      if (s.source < 0) return;
      const PathPoint& point = path.points[static_cast<std::size_t>(s.source)];
      if (point.moving && point.moving->coordinate >= 0) {
        result.moment_arm_m[point.moving->coordinate] -=
            sign * u.dot(moving_rate(model, point, state));
      }
    };
    add_moving(b, 1.0);
    add_moving(a, -1.0);
  }
  result.speed_mps = -result.moment_arm_m.dot(state.qdot);
  return result;
}

}  // namespace myoid::model
