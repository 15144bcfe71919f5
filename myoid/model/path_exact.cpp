#include "myoid/model/path_exact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "myoid/model/wrap_cylinder.h"
#include "myoid/model/wrap_ellipsoid.h"

namespace myoid::model {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Puts the contact of one wrap, if there is any, where it obstructs the path.
void insert_wrap(const BodyModel& model,
                 const PathWrap& wrap,
                 int number,
                 const BodyState& state,
                 std::vector<PathStation>& stations) {
  const WrapObject& object = model.wrap_objects[at(wrap.wrap_object)];
  if (!object.active) return;
  const auto* cylinder = std::get_if<CylinderShape>(&object.shape);
  const auto* ellipsoid = std::get_if<EllipsoidShape>(&object.shape);
  if (cylinder == nullptr && ellipsoid == nullptr) return;
  const Pose X_GW = state.X_GB[at(object.body)] * object.X_BW;
  const Pose X_WG = X_GW.inverse();
  std::size_t best = stations.size();
  double best_change = std::numeric_limits<double>::infinity();
  WrapContact best_contact;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    if (stations[i].on_wrap_after) continue;
    const auto in_range = [&](const PathStation& s) {
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
    PathStation s;
    s.body = object.body;
    s.p_B = object.X_BW * p_W;
    s.p_G = X_GW * p_W;
    s.wrap = number;
    return s;
  };
  PathStation first = tangent(best_contact.first_W);
  first.on_wrap_after = true;
  first.arc_after_m = best_contact.arc_length_m;
  const auto where = stations.begin() + static_cast<std::ptrdiff_t>(best) + 1;
  stations.insert(where, {first, tangent(best_contact.second_W)});
}

}  // namespace

void compute_exact_path(const BodyModel& model,
                        const MusclePath& path,
                        const BodyState& state,
                        PathWorkspace& workspace,
                        PathResult& result) {
  place_points(model, path, state, workspace);
  auto& stations = workspace.stations;
  if (!path.wraps.empty()) {
    // Each object in turn against its neighbours as they stand, until the length settles.
    double last = std::numeric_limits<double>::infinity();
    const int passes = path.wraps.size() == 1 ? 1 : 60;
    for (int pass = 0; pass < passes; ++pass) {
      for (std::size_t w = 0; w < path.wraps.size(); ++w) {
        const int number = static_cast<int>(w);
        std::erase_if(stations, [number](const PathStation& s) { return s.wrap == number; });
        insert_wrap(model, path.wraps[w], number, state, stations);
      }
      const double length = length_of(stations);
      if (std::abs(length - last) < 1e-13) break;
      last = length;
    }
  }
  result.wrapped = false;
  for (const PathStation& s : stations) result.wrapped = result.wrapped || s.wrap >= 0;
  result.length_m = length_of(stations);
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    if (stations[i].on_wrap_after) continue;
    const PathStation& a = stations[i];
    const PathStation& b = stations[i + 1];
    const Vec3 along = b.p_G - a.p_G;
    const double length = along.norm();
    if (!(length > 0.0)) continue;
    const Vec3 u = along / length;
    add_pair_moment(model, state, a.body, a.p_G, b.body, b.p_G, u, result.moment_arm_m);
    const auto add_moving = [&](const PathStation& s, double sign) {
      if (s.source < 0) return;
      const PathPoint& point = path.points[at(s.source)];
      if (point.moving && point.moving->coordinate >= 0) {
        result.moment_arm_m[point.moving->coordinate] -=
            sign * u.dot(moving_rate(model, point, state, false));
      }
    };
    add_moving(b, 1.0);
    add_moving(a, -1.0);
  }
  result.speed_mps = -result.moment_arm_m.dot(state.qdot);
}

}  // namespace myoid::model
