#include <cmath>
#include <limits>
#include <numeric>

#include "myoid/body/model/opensim_defects/wrap_opensim.h"
#include "myoid/body/model/path_stations.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

/// The wrapping of one path at one posture.
class Wrapping {
 public:
  Wrapping(const PosedPath& posed, PathWorkspace& workspace)
      : model_(posed.model), path_(posed.path), state_(posed.state), w_(workspace) {
    w_.is_seen.assign(path_.wraps.size(), 0);
    w_.first_seen_G.resize(path_.wraps.size());
    w_.order.resize(path_.wraps.size());
    std::iota(w_.order.begin(), w_.order.end(), 0);
  }

  void run() {
    constexpr double kSettled_m = 0.0005;
    const int passes = path_.wraps.size() == 1 ? 1 : 8;
    double last = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < passes; ++pass) {
      WrapAction first = WrapAction::none;
      WrapAction second = WrapAction::none;
      for (std::size_t i = 0; i < path_.wraps.size(); ++i) {
        WrapAction action = WrapAction::none;
        if (!apply(w_.order[i], action)) return;
        if (i == 0) first = action;
        if (i == 1) second = action;
      }
      const double length = length_of(w_.stations);
      if (std::abs(length - last) < kSettled_m) return;
      last = length;
      // The first object has no contact because the second has a point inside: exchange their order.
      if (pass == 0 && passes > 1 && first == WrapAction::none && second == WrapAction::inside) {
        w_.order[0] = 1;
        w_.order[1] = 0;
        remove(0);
      }
    }
  }

 private:
  void remove(int wrap) {
    std::erase_if(w_.stations, [wrap](const PathStation& s) { return s.wrap == wrap; });
  }

  /// True if two neighbors are tangent points of one object.
  [[nodiscard]] bool on_one_object(const PathStation& a, const PathStation& b) const {
    return a.wrap >= 0 && b.wrap >= 0 && path_.wraps[at(a.wrap)].wrap_object == path_.wraps[at(b.wrap)].wrap_object;
  }

  /// Wraps the current path around one object. False: the range holds no active point, and OpenSim changes nothing.
  bool apply(int number, WrapAction& action) {
    const PathWrap& wrap = path_.wraps[at(number)];
    const WrapObject& object = model_.wrap_objects[at(wrap.wrap_object)];
    remove(number);
    if (!object.active) return true;
    const auto [begin, end] = station_range(path_, wrap, w_.stations);
    if (end < 0) return false;
    const Pose X_GW = state_.X_GB[at(object.body)] * object.X_BW;
    const Pose X_WG = X_GW.inverse();
    const auto in_wrap_frame = [&](const PathStation& s) -> Vec3 { return X_WG * (state_.X_GB[at(s.body)] * s.p_B); };
    double smallest = std::numeric_limits<double>::infinity();
    OpenSimContact best;
    int best_segment = -1;
    for (int i = begin; i < end; ++i) {
      const PathStation& a = w_.stations[at(i)];
      const PathStation& b = w_.stations[at(i + 1)];
      if (on_one_object(a, b)) continue;
      const OpenSimContact contact = opensim_contact(object, wrap.method, in_wrap_frame(a), in_wrap_frame(b),
                                                     path_.wraps.size() == 1, model_.compat);
      action = contact.action;
      if (action == WrapAction::mandatory) {
        best = contact;
        best_segment = i;
        break;
      }
      if (action == WrapAction::wrapped && contact.has_points) {
        const double change = (X_GW * contact.first_W - a.p_G).norm() + contact.arc_length_m +
                              (X_GW * contact.second_W - b.p_G).norm() - (b.p_G - a.p_G).norm();
        if (change < smallest) {
          smallest = change;
          best = contact;
          best_segment = i;
        }
      }
    }
    if (best_segment < 0 || !best.has_points) return true;
    insert(number, object, X_GW, best, best_segment);
    return true;
  }

  void insert(int number, const WrapObject& object, const Pose& X_GW, const OpenSimContact& contact, int segment) {
    auto stations = contact_stations(object, number, X_GW, contact.first_W, contact.second_W, contact.arc_length_m);
    auto& [first, second] = stations;
    auto& seen = w_.first_seen_G[at(number)];
    if (w_.is_seen[at(number)] == 0) {
      seen = {first.p_G, second.p_G};
      w_.is_seen[at(number)] = 1;
    }
    if (model_.compat.stale_wrap_points) {
      first.p_G = seen[0];
      second.p_G = seen[1];
    }
    insert_behind(w_.stations, segment, stations);
  }

  const BodyModel& model_;
  const MusclePath& path_;
  const BodyState& state_;
  PathWorkspace& w_;
};

/// Returns the velocity of a station: the body's at that point plus the station's in the body.
Vec3 velocity(const PosedPath& posed, const PathStation& s) {
  const BodyState& state = posed.state;
  const std::size_t b = at(s.body);
  Vec3 v = state.v_GB[b] + state.w_GB[b].cross(state.X_GB[b].R * s.p_B);
  if (const PathPoint* point = moving_point(posed.path, s)) {
    for_each_moving_rate(posed, *point, true,
                         [&](int coordinate, const Vec3& rate) { v += state.qdot[coordinate] * rate; });
  }
  return v;
}

}  // namespace

void compute_opensim_path(const PosedPath& posed, PathWorkspace& workspace, PathResult& result) {
  const auto& [model, path, state] = posed;
  place_points(posed, workspace);
  if (!path.wraps.empty()) Wrapping(posed, workspace).run();
  const auto& stations = workspace.stations;
  result.length_m = length_of(stations);
  result.speed_mps = 0.0;
  result.settled = true;
  result.wrapped = false;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const PathStation& a = stations[i];
    const PathStation& b = stations[i + 1];
    result.wrapped = result.wrapped || a.on_wrap_after;
    const Vec3 along = b.p_G - a.p_G;
    const double length = along.norm();
    if (length == 0.0) continue;
    const Vec3 u = along / length;
    result.speed_mps += (velocity(posed, b) - velocity(posed, a)).dot(u);
    const bool one_body = a.body == b.body;
    if (one_body && model.compat.unseen_moving_points) continue;
    if (!one_body) {
      add_pair_moment(model, state, a.body, state.X_GB[at(a.body)] * a.p_B, b.body, state.X_GB[at(b.body)] * b.p_B, u,
                      result.moment_arm_m);
    }
    add_moving_moments(posed, a, b, u, true, result.moment_arm_m);
  }
}

}  // namespace myoid::body
