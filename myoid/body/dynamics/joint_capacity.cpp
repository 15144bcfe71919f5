#include "myoid/body/dynamics/joint_capacity.h"

#include <algorithm>
#include <cmath>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {

double JointCapacity::isometric_nm() const { return std::max(positive_nm, negative_nm); }

double JointCapacity::greatest_nm() const {
  constexpr double kStrongest = 2.5;
  constexpr double kLengthening = 1.5;
  return kStrongest * kLengthening * isometric_nm() + body_mass_kg * kStandardGravity * lever_m;
}

std::vector<bool> moved_bodies(const body::BodyModel& model, int joint) {
  std::vector<bool> moved(model.bodies.size(), false);
  moved[at(model.joints[at(joint)].child)] = true;
  // A parent's joint comes before its child's.
  for (const body::Joint& j : model.joints) {
    if (moved[at(j.parent)]) moved[at(j.child)] = true;
  }
  return moved;
}

JointCapacity joint_capacity(const body::BodyModel& model, const std::string& coordinate, double body_mass_kg) {
  constexpr int kSteps = 12;
  const int index = model.coordinate_index(coordinate);
  const body::Coordinate& c = model.coordinates[at(index)];
  const double turn = c.motion == body::MotionType::translational ? 1.0 : kPi;
  const double from = std::max(c.lower, c.default_value - turn);
  const double to = std::max(from, std::min(c.upper, c.default_value + turn));
  JointCapacity capacity;
  body::BodyState state = body::make_state(model);
  Eigen::VectorXd q = model.default_q();
  for (int step = 0; step <= kSteps; ++step) {
    q[index] = from + (to - from) * step / kSteps;
    body::compute_poses(model, q, state);
    double positive = 0.0;
    double negative = 0.0;
    for (std::size_t m = 0; m < model.muscles.size(); ++m) {
      const body::PathResult path = body::compute_path(model, static_cast<int>(m), state);
      const double torque = path.moment_arm_m[index] * model.muscles[m].properties.max_isometric_force_n;
      if (!std::isfinite(torque)) continue;
      (torque > 0.0 ? positive : negative) += std::abs(torque);
    }
    capacity.positive_nm = std::max(capacity.positive_nm, positive);
    capacity.negative_nm = std::max(capacity.negative_nm, negative);
  }
  q = model.default_q();
  body::compute_poses(model, q, state);
  const body::Joint& joint = model.joints[at(c.joint)];
  const std::vector<bool> moved = moved_bodies(model, c.joint);
  const Vec3 center = state.X_GB[at(joint.child)] * joint.X_BM.p;
  double mass = 0.0;
  for (std::size_t b = 1; b < model.bodies.size(); ++b) {
    mass += model.bodies[b].mass_kg;
    if (moved[b])
      capacity.lever_m = std::max(capacity.lever_m, (state.X_GB[b] * model.bodies[b].p_BBcm_B - center).norm());
  }
  for (const body::Marker& marker : model.markers) {
    const auto b = at(marker.body);
    if (moved[b]) capacity.lever_m = std::max(capacity.lever_m, (state.X_GB[b] * marker.p_BM - center).norm());
  }
  capacity.lever_m = std::min(capacity.lever_m, kLongestLever_m);
  capacity.body_mass_kg = body_mass_kg > 0.0 ? body_mass_kg : std::max(mass, kLightBody_kg);
  return capacity;
}

}  // namespace myoid::body
