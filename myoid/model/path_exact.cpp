#include "myoid/model/path_exact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "myoid/core/index.h"
#include "myoid/model/path_contacts.h"

namespace myoid::model {
namespace {

/// Whether the way over the object is the shortest, so that the tangent points' own motion does not
/// change the length.
bool is_shortest(const WrapObject& object) {
  return std::holds_alternative<CylinderShape>(object.shape) ||
         std::holds_alternative<SphereShape>(object.shape);
}

/// What a pass knows of an object: without contact, in contact, or left out for good.
enum ContactState : char { kFree = 0, kTouching = 1, kLeftOut = 2 };

/// Puts the contact of one wrap, if there is any, where it was in the pass before, else where it
/// lengthens the path least. Returns how far its tangent points are from where they were.
/// `final_loss`: an object that loses its contact now has lost it for good.
double insert_wrap(const BodyModel& model,
                   const MusclePath& path,
                   int number,
                   const BodyState& state,
                   bool final_loss,
                   PathWorkspace& workspace) {
  const PathWrap& wrap = path.wraps[at(number)];
  const WrapObject& object = model.wrap_objects[at(wrap.wrap_object)];
  auto& stations = workspace.stations;
  // Objects that look for a new place in every pass can change places with each other for ever.
  const auto is_ours = [number](const PathStation& s) { return s.wrap == number; };
  const int former =
      static_cast<int>(std::find_if(stations.begin(), stations.end(), is_ours) - stations.begin()) -
      1;
  std::erase_if(stations, is_ours);
  auto& before = workspace.first_seen_G[at(number)];
  char& known = workspace.is_seen[at(number)];
  if (!object.active || known == kLeftOut) return 0.0;
  const auto [begin, end] = station_range(path, wrap, stations);
  const Pose X_GW = state.X_GB[at(object.body)] * object.X_BW;
  const Pose X_WG = X_GW.inverse();
  int best = -1;
  double best_change = std::numeric_limits<double>::infinity();
  WrapContact best_contact;
  const auto consider = [&](int i) {
    if (stations[at(i)].on_wrap_after) return false;
    const Vec3 p_W = X_WG * stations[at(i)].p_G;
    const Vec3 q_W = X_WG * stations[at(i + 1)].p_G;
    const auto contact = contact_over(object, wrap.method, p_W, q_W);
    if (!contact) return false;
    const double change = (contact->first_W - p_W).norm() + contact->arc_length_m +
                          (q_W - contact->second_W).norm() - (q_W - p_W).norm();
    if (change < best_change) {
      best_change = change;
      best = i;
      best_contact = *contact;
    }
    return true;
  };
  const bool was_there = known == kTouching;
  const bool stays = was_there && former >= begin && former < end && consider(former);
  if (!stays && !(was_there && final_loss)) {
    for (int i = begin; i < end; ++i) {
      // The first piece that cuts an ellipsoid takes it.
      if (consider(i) && std::holds_alternative<EllipsoidShape>(object.shape)) break;
    }
  }
  known = best >= 0 ? kTouching : was_there && final_loss ? kLeftOut : kFree;
  if (best < 0) return was_there ? std::numeric_limits<double>::infinity() : 0.0;
  PathStation first;
  first.body = object.body;
  first.wrap = number;
  first.p_B = object.X_BW * best_contact.first_W;
  first.p_G = X_GW * best_contact.first_W;
  PathStation second = first;
  second.p_B = object.X_BW * best_contact.second_W;
  second.p_G = X_GW * best_contact.second_W;
  first.on_wrap_after = true;
  first.arc_after_m = best_contact.arc_length_m;
  // Another segment is no rest, even at the same place: two objects may change places for ever.
  const double moved =
      stays ? std::max((first.p_G - before[0]).norm(), (second.p_G - before[1]).norm())
            : std::numeric_limits<double>::infinity();
  before = {first.p_G, second.p_G};
  const auto where = stations.begin() + best + 1;
  stations.insert(stations.insert(where, second), first);
  return moved;
}

/// Each object in turn against its neighbors as they stand, until the tangent points rest. Objects
/// may push the path off each other in a circle, each in contact only without the other: then the
/// one that loses its contact first after some passes is left out. False: they do not rest.
bool wrap_all(const BodyModel& model,
              const MusclePath& path,
              const BodyState& state,
              PathWorkspace& workspace) {
  constexpr int kMostPasses = 200;
  constexpr double kResting_m = 1e-13;
  workspace.first_seen_G.resize(path.wraps.size());
  workspace.is_seen.assign(path.wraps.size(), 0);
  constexpr int kPatientPasses = 8;
  const int passes = path.wraps.size() == 1 ? 1 : kMostPasses;
  for (int pass = 0; pass < passes; ++pass) {
    // Where the passes creep, a step of Newton's method on all tangent points at once.
    if (pass >= kPatientPasses && pass % 3 == 0) refine_contacts(model, path, state, workspace);
    double moved = 0.0;
    for (std::size_t w = 0; w < path.wraps.size(); ++w)
      moved = std::max(moved, insert_wrap(model, path, static_cast<int>(w), state,
                                          pass >= kPatientPasses, workspace));
    if (moved < kResting_m) return true;
  }
  return passes == 1;
}

}  // namespace

void compute_exact_path(const BodyModel& model,
                        const MusclePath& path,
                        const BodyState& state,
                        PathWorkspace& workspace,
                        PathResult& result) {
  place_points(model, path, state, workspace);
  result.settled = path.wraps.empty() || wrap_all(model, path, state, workspace);
  const auto& stations = workspace.stations;
  result.wrapped = false;
  bool shortest = true;
  for (const PathStation& s : stations) {
    if (s.wrap < 0) continue;
    result.wrapped = true;
    shortest = shortest && is_shortest(model.wrap_objects[at(path.wraps[at(s.wrap)].wrap_object)]);
  }
  result.length_m = length_of(stations);
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    if (stations[i].on_wrap_after) continue;
    const PathStation& a = stations[i];
    const PathStation& b = stations[i + 1];
    const Vec3 u = straight_direction(a, b);
    if (u.isZero(0.0)) continue;
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
  if (!shortest) add_contact_motion(model, path, state, stations, result.moment_arm_m);
  result.speed_mps = -result.moment_arm_m.dot(state.qdot);
}

}  // namespace myoid::model
