#include <algorithm>
#include <limits>

#include "myoid/body/model/path_contacts.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

/// Returns true if the path over the object is the shortest: motion of the tangent points then does
/// not change the length to first order.
bool is_shortest(const WrapObject& object) {
  return std::holds_alternative<CylinderShape>(object.shape) || std::holds_alternative<SphereShape>(object.shape);
}

/// State of an object in the passes: without contact, in contact, or left out of all further passes.
enum ContactState : char { kFree = 0, kTouching = 1, kLeftOut = 2 };

/// The search for the segment over which an object lengthens a path least.
class SegmentSearch {
 public:
  SegmentSearch(const WrapObject& object, WrapMethod method, const Pose& X_GW, const std::vector<PathStation>& stations)
      : object_(object), method_(method), X_WG_(X_GW.inverse()), stations_(stations) {}

  /// Compares segment i with the best one; false: the segment has no contact.
  bool consider(int i) {
    if (stations_[at(i)].on_wrap_after) return false;
    const Vec3 p_W = X_WG_ * stations_[at(i)].p_G;
    const Vec3 q_W = X_WG_ * stations_[at(i + 1)].p_G;
    const auto contact = contact_over(object_, method_, p_W, q_W);
    if (!contact) return false;
    const double change =
        (contact->first_W - p_W).norm() + contact->arc_length_m + (q_W - contact->second_W).norm() - (q_W - p_W).norm();
    if (change < best_change_) {
      best_change_ = change;
      segment = i;
      best = *contact;
    }
    return true;
  }

  int segment = -1;  ///< The best segment; -1 without contact.
  WrapContact best;  ///< Its contact.

 private:
  const WrapObject& object_;
  WrapMethod method_;
  Pose X_WG_;
  const std::vector<PathStation>& stations_;
  double best_change_ = std::numeric_limits<double>::infinity();
};

/// Puts the contact of one wrap on its segment of the previous pass or, without contact there, on the segment that
/// lengthens the path least. Returns the distance that its tangent points have moved. `final_loss`: an object that
/// loses its contact in this pass is left out of all further passes.
double insert_wrap(const PosedPath& posed, int number, bool final_loss, PathWorkspace& workspace) {
  const auto& [model, path, state] = posed;
  const PathWrap& wrap = path.wraps[at(number)];
  const WrapObject& object = model.wrap_objects[at(wrap.wrap_object)];
  auto& stations = workspace.stations;
  // Objects that look for a new place in every pass could exchange places without end.
  const auto is_ours = [number](const PathStation& s) { return s.wrap == number; };
  const int former = static_cast<int>(std::find_if(stations.begin(), stations.end(), is_ours) - stations.begin()) - 1;
  std::erase_if(stations, is_ours);
  auto& before = workspace.first_seen_G[at(number)];
  char& known = workspace.is_seen[at(number)];
  if (!object.active || known == kLeftOut) return 0.0;
  const auto [begin, end] = station_range(path, wrap, stations);
  const Pose X_GW = state.X_GB[at(object.body)] * object.X_BW;
  SegmentSearch search(object, wrap.method, X_GW, stations);
  const bool was_there = known == kTouching;
  const bool stays = was_there && former >= begin && former < end && search.consider(former);
  if (!stays && !(was_there && final_loss)) {
    for (int i = begin; i < end; ++i) {
      // An ellipsoid wraps the first segment that cuts the surface.
      if (search.consider(i) && std::holds_alternative<EllipsoidShape>(object.shape)) break;
    }
  }
  known = search.segment >= 0 ? kTouching : was_there && final_loss ? kLeftOut : kFree;
  if (search.segment < 0) return was_there ? std::numeric_limits<double>::infinity() : 0.0;
  const auto contact =
      contact_stations(object, number, X_GW, search.best.first_W, search.best.second_W, search.best.arc_length_m);
  const auto& [first, second] = contact;
  // A change of segment counts as motion, even to the same place: two objects may change places.
  const double moved = stays ? std::max((first.p_G - before[0]).norm(), (second.p_G - before[1]).norm())
                             : std::numeric_limits<double>::infinity();
  before = {first.p_G, second.p_G};
  insert_behind(stations, search.segment, contact);
  return moved;
}

/// Fits each object in turn to its current neighbors until the tangent points rest. Two objects may
/// push the path off each other, each in contact only without the other: the object that first
/// loses its contact after some passes is then left out. False: the tangent points do not rest.
bool wrap_all(const PosedPath& posed, PathWorkspace& workspace) {
  const std::size_t wraps = posed.path.wraps.size();
  constexpr int kMostPasses = 200;
  constexpr double kResting_m = 1e-13;
  workspace.first_seen_G.resize(wraps);
  workspace.is_seen.assign(wraps, 0);
  constexpr int kPatientPasses = 8;
  const int passes = wraps == 1 ? 1 : kMostPasses;
  for (int pass = 0; pass < passes; ++pass) {
    // Slow passes: a step of Newton's method on all tangent points at once.
    if (pass >= kPatientPasses && pass % 3 == 0) refine_contacts(posed, workspace);
    double moved = 0.0;
    for (std::size_t w = 0; w < wraps; ++w)
      moved = std::max(moved, insert_wrap(posed, static_cast<int>(w), pass >= kPatientPasses, workspace));
    if (moved < kResting_m) return true;
  }
  return passes == 1;
}

}  // namespace

void compute_exact_path(const PosedPath& posed, PathWorkspace& workspace, PathResult& result) {
  const auto& [model, path, state] = posed;
  place_points(posed, workspace);
  result.settled = path.wraps.empty() || wrap_all(posed, workspace);
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
    add_moving_moments(posed, a, b, u, false, result.moment_arm_m);
  }
  if (!shortest) add_contact_motion(posed, stations, result.moment_arm_m);
  result.speed_mps = -result.moment_arm_m.dot(state.qdot);
}

}  // namespace myoid::body
