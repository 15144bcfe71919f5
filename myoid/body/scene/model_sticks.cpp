#include "myoid/body/scene/model_sticks.h"

#include <algorithm>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

/// The joint of a child, in the parent.
struct ChildJoint {
  Vec3 p_B = Vec3::Zero();
  double carried_kg = 0.0;  ///< Mass of the child and of all bodies beyond it.
};

/// Returns the mass of every body and of all bodies beyond it; joints are in tree order.
std::vector<double> carried_masses(const body::BodyModel& model) {
  std::vector<double> carried_kg;
  for (const body::Body& body : model.bodies) carried_kg.push_back(body.mass_kg);
  for (auto joint = model.joints.rbegin(); joint != model.joints.rend(); ++joint)
    carried_kg[at(joint->parent)] += carried_kg[at(joint->child)];
  return carried_kg;
}

BodySticks to_children(const Vec3& own, std::vector<ChildJoint> children) {
  std::ranges::stable_sort(children,
                           [](const ChildJoint& a, const ChildJoint& b) { return a.carried_kg > b.carried_kg; });
  BodySticks sticks;
  const auto add = [&](const Vec3& from, const Vec3& to) {
    if (from != to) sticks.push_back({from, to});
  };
  std::vector<Vec3> ends;
  for (std::size_t i = 0; i < children.size(); ++i) {
    const Vec3& here = children[i].p_B;
    const auto sibling =
        std::find_if(children.begin(), children.begin() + static_cast<std::ptrdiff_t>(i),
                     [&](const ChildJoint& s) { return 3.0 * (here - s.p_B).norm() < (here - own).norm(); });
    if (sibling != children.begin() + static_cast<std::ptrdiff_t>(i)) {
      add(sibling->p_B, here);
    } else {
      ends.push_back(here);
    }
  }
  // Distant ends close to each other share a stem.
  Vec3 fork = own;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& end : ends) middle += end / static_cast<double>(ends.size());
  const bool is_fork = ends.size() > 1 && std::ranges::all_of(ends, [&](const Vec3& e) {
                         return (e - middle).norm() < (middle - own).norm();
                       });
  if (is_fork) {
    fork = middle;
    add(own, fork);
  }
  for (const Vec3& end : ends) add(fork, end);
  return sticks;
}

/// Markers and muscle points of a body.
std::vector<Vec3> attached_points(const body::BodyModel& model, int body) {
  std::vector<Vec3> points;
  for (const body::Marker& m : model.markers)
    if (m.body == body) points.push_back(m.p_BM);
  for (const body::Muscle& muscle : model.muscles)
    for (const body::PathPoint& p : muscle.path.points)
      if (p.body == body && !p.moving) points.push_back(p.p_BP);
  return points;
}

BodySticks to_the_tip(const body::BodyModel& model, int body, const Vec3& own) {
  const Vec3 along = model.bodies[at(body)].p_BBcm_B - own;
  double reach = along.norm();
  if (!(reach > 0.0)) return {};
  const Vec3 direction = along / reach;
  for (const Vec3& p : attached_points(model, body)) reach = std::max(reach, direction.dot(p - own));
  return {{own, own + reach * direction}};
}

}  // namespace

std::vector<BodySticks> body_sticks(const body::BodyModel& model) {
  const std::vector<double> carried_kg = carried_masses(model);
  body::BodyState state = body::make_state(model);
  body::compute_poses(model, model.default_q(), state);
  std::vector<std::vector<ChildJoint>> children(model.bodies.size());
  std::vector<Vec3> own(model.bodies.size(), Vec3::Zero());
  for (const body::Joint& joint : model.joints) {
    const Vec3 p_G = state.X_GB[at(joint.child)] * joint.X_BM.p;
    children[at(joint.parent)].push_back({state.X_GB[at(joint.parent)].inverse() * p_G, carried_kg[at(joint.child)]});
    own[at(joint.child)] = joint.X_BM.p;
  }
  std::vector<BodySticks> sticks(model.bodies.size());
  for (std::size_t b = 1; b < sticks.size(); ++b) {
    sticks[b] = children[b].empty() ? to_the_tip(model, static_cast<int>(b), own[b])
                                    : to_children(own[b], std::move(children[b]));
  }
  return sticks;
}

}  // namespace myoid::body
