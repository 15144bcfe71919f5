#include "myoid/model/path_exact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/LU>

#include "myoid/model/wrap_cylinder.h"
#include "myoid/model/wrap_ellipsoid.h"
#include "myoid/model/wrap_sphere.h"
#include "myoid/model/wrap_torus.h"

namespace myoid::model {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

std::size_t at(Eigen::Index index) { return static_cast<std::size_t>(index); }

template <typename T>
std::optional<ContactOf<T>> contact_with(const WrapObject& object,
                                         WrapMethod method,
                                         const Vector3<T>& p_W,
                                         const Vector3<T>& q_W) {
  if (const auto* cylinder = std::get_if<CylinderShape>(&object.shape))
    return wrap_cylinder<T>(*cylinder, object.quadrant, p_W, q_W);
  if (const auto* sphere = std::get_if<SphereShape>(&object.shape))
    return wrap_sphere<T>(*sphere, object.quadrant, p_W, q_W);
  if (const auto* torus = std::get_if<TorusShape>(&object.shape))
    return wrap_torus<T>(*torus, object.quadrant, p_W, q_W);
  return wrap_ellipsoid<T>(std::get<EllipsoidShape>(object.shape), object.quadrant, method, p_W,
                           q_W);
}

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
    const auto contact = contact_with<double>(object, wrap.method, p_W, q_W);
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
  const double moved =
      was_there ? std::max((first.p_G - before[0]).norm(), (second.p_G - before[1]).norm())
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
    double moved = 0.0;
    for (std::size_t w = 0; w < path.wraps.size(); ++w)
      moved = std::max(moved, insert_wrap(model, path, static_cast<int>(w), state,
                                          pass >= kPatientPasses, workspace));
    if (moved < kResting_m) return true;
  }
  return passes == 1;
}

/// How the tangent points and the arc of one contact change with the ends of its straight pieces.
struct Sensitivity {
  int station = 0;  ///< Of the first tangent point.
  Mat3 R_GW;
  Mat6 points;   ///< Of (first, second) by (end before, end after), all in the wrap's frame.
  Vec6 arc;      ///< Of the arc's length by the ends.
  Vec6 tension;  ///< dl by the tangent points, the straight pieces alone.
  Vec6 total;    ///< dl by the tangent points, with what follows at the neighboring contacts.
  Vec6 effect;   ///< dl by the ends, through this contact.
};

Vec3 straight_direction(const PathStation& a, const PathStation& b) {
  const Vec3 along = b.p_G - a.p_G;
  const double length = along.norm();
  return length > 0.0 ? Vec3(along / length) : Vec3::Zero();
}

/// Adds what the tangent points' own motion on their objects contributes to the moment arms.
void add_contact_motion(const BodyModel& model,
                        const MusclePath& path,
                        const BodyState& state,
                        const std::vector<PathStation>& stations,
                        Eigen::VectorXd& arm) {
  std::vector<Sensitivity> contacts;
  for (std::size_t i = 1; i + 2 < stations.size(); ++i) {
    if (!stations[i].on_wrap_after) continue;
    const PathWrap& wrap = path.wraps[at(stations[i].wrap)];
    const WrapObject& object = model.wrap_objects[at(wrap.wrap_object)];
    const Pose X_GW = state.X_GB[at(object.body)] * object.X_BW;
    const Pose X_WG = X_GW.inverse();
    const Vec3 p = X_WG * stations[i - 1].p_G;
    const Vec3 q = X_WG * stations[i + 2].p_G;
    Vector3<Jet6> pj, qj;
    for (int k = 0; k < 3; ++k) {
      pj[k] = Jet6(p[k], k);
      qj[k] = Jet6(q[k], k + 3);
    }
    const auto contact = contact_with<Jet6>(object, wrap.method, pj, qj);
    if (!contact) continue;  // at the very edge of touching
    Sensitivity s;
    s.station = static_cast<int>(i);
    s.R_GW = X_GW.R;
    for (int k = 0; k < 3; ++k) {
      s.points.row(k) = contact->first_W[k].v.transpose();
      s.points.row(k + 3) = contact->second_W[k].v.transpose();
    }
    s.arc = contact->arc_length_m.v;
    s.tension << s.R_GW.transpose() * straight_direction(stations[i - 1], stations[i]),
        -(s.R_GW.transpose() * straight_direction(stations[i + 1], stations[i + 2]));
    s.total = s.tension;
    contacts.push_back(s);
  }
  // A contact's tangent points are the ends of its neighbors' straight pieces: the derivatives by
  // all of them together.
  const auto n = static_cast<Eigen::Index>(contacts.size());
  if (n > 1) {
    Eigen::MatrixXd left = Eigen::MatrixXd::Identity(6 * n, 6 * n);
    Eigen::VectorXd right(6 * n);
    for (Eigen::Index k = 0; k < n; ++k) right.segment<6>(6 * k) = contacts[at(k)].tension;
    // Contact `of` sees its neighbor `by` through what the neighbor's effect on its near end is.
    const auto couple = [&](Eigen::Index of, Eigen::Index by, int end_of, int end_by) {
      const Sensitivity& a = contacts[at(of)];
      const Sensitivity& b = contacts[at(by)];
      const Mat3 turn = a.R_GW.transpose() * b.R_GW;
      left.block<3, 6>(6 * of + end_of, 6 * by) =
          -turn * b.points.transpose().middleRows<3>(end_by);
      right.segment<3>(6 * of + end_of) += turn * b.arc.segment<3>(end_by);
    };
    for (Eigen::Index k = 0; k + 1 < n; ++k) {
      if (contacts[at(k)].station + 2 != contacts[at(k + 1)].station) continue;
      couple(k + 1, k, 0, 3);
      couple(k, k + 1, 3, 0);
    }
    const Eigen::VectorXd total = left.partialPivLu().solve(right);
    for (Eigen::Index k = 0; k < n; ++k) contacts[at(k)].total = total.segment<6>(6 * k);
  }
  for (Sensitivity& s : contacts) s.effect = s.points.transpose() * s.total + s.arc;
  for (const Sensitivity& s : contacts) {
    const PathStation& tangent = stations[at(s.station)];
    const auto add = [&](const PathStation& end, const Vec3& by_end_W) {
      const Vec3 by_end_G = s.R_GW * by_end_W;
      add_pair_moment(model, state, tangent.body, end.p_G, end.body, end.p_G, by_end_G, arm);
      if (end.source < 0) return;
      const PathPoint& point = path.points[at(end.source)];
      if (point.moving && point.moving->coordinate >= 0)
        arm[point.moving->coordinate] -= by_end_G.dot(moving_rate(model, point, state, false));
    };
    add(stations[at(s.station - 1)], s.effect.head<3>());
    add(stations[at(s.station + 2)], s.effect.tail<3>());
  }
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
