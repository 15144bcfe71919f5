#include "myoid/body/forces/actuator_columns.h"

#include <algorithm>
#include <utility>

#include "myoid/body/kinematics/angular_speeds.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

const body::MusclePath& path_of(const body::BodyModel& model, const Actuator& a) {
  return a.kind == Actuator::Kind::muscle ? model.muscles[a.index].path : model.path_actuators[a.index].path;
}

/// Returns a point actuator's point in its body and its direction in ground.
std::pair<Vec3, Vec3> line_of(const body::PointActuator& p, const body::BodyState& state) {
  const Pose& X_GB = state.X_GB[at(p.body)];
  return {p.point_is_global ? Vec3(X_GB.inverse() * p.point) : p.point,
          p.force_is_global ? p.direction : Vec3(X_GB.R * p.direction)};
}

Vec3 axis_of(const body::TorqueActuator& t, const body::BodyState& state) {
  return t.torque_is_global ? t.axis : Vec3(state.X_GB[at(t.body_a)].R * t.axis);
}

}  // namespace

std::vector<Actuator> actuators_of(const body::BodyModel& model) {
  std::vector<Actuator> all;
  const auto add = [&](Actuator::Kind kind, const auto& list) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!list[i].applies_force) continue;
      if constexpr (requires { list[i].properties; }) {
        const body::MuscleProperties& p = list[i].properties;
        all.push_back({kind, i, list[i].name, p.control.least, p.control.most, p.max_isometric_force_n});
      } else {
        all.push_back({kind, i, list[i].name, list[i].min_control, list[i].max_control, list[i].optimal_force});
      }
    }
  };
  add(Actuator::Kind::muscle, model.muscles);
  add(Actuator::Kind::coordinate, model.actuators);
  add(Actuator::Kind::point, model.point_actuators);
  add(Actuator::Kind::torque, model.torque_actuators);
  add(Actuator::Kind::path, model.path_actuators);
  const auto place = [&](const Actuator& a) {
    return std::find(model.force_order.begin(), model.force_order.end(), a.name) - model.force_order.begin();
  };
  std::stable_sort(all.begin(), all.end(), [&](const Actuator& a, const Actuator& b) { return place(a) < place(b); });
  return all;
}

const Eigen::VectorXd& ActuatorColumns::of_unit_force(const Actuator& a, const body::BodyState& state) {
  const body::BodyModel& model = *model_;
  column_.setZero(static_cast<Eigen::Index>(model.coordinates.size()));
  switch (a.kind) {
    case Actuator::Kind::muscle:
    case Actuator::Kind::path:
      body::compute_path(model, path_of(model, a), state, workspace_, path_);
      column_ = path_.moment_arm_m;
      break;
    case Actuator::Kind::coordinate:
      column_[model.actuators[a.index].coordinate] = 1.0;
      column_ = body::on_rates(model, state.q, std::move(column_));
      break;
    case Actuator::Kind::point: {
      const body::PointActuator& p = model.point_actuators[a.index];
      const auto [station, direction] = line_of(p, state);
      column_ = body::station_jacobian(model, state, p.body, station).transpose() * direction;
      break;
    }
    case Actuator::Kind::torque: {
      const body::TorqueActuator& t = model.torque_actuators[a.index];
      const Vec3 axis = axis_of(t, state);
      const Eigen::Matrix3Xd turning_a = body::angular_jacobian(model, state, t.body_a);
      const Eigen::Matrix3Xd turning_b = body::angular_jacobian(model, state, t.body_b);
      for (Eigen::Index c = 0; c < column_.size(); ++c)
        column_[c] = axis.dot(Vec3(turning_a.col(c) - turning_b.col(c)));
      break;
    }
  }
  return column_;
}

void ActuatorColumns::append_wrenches(const Actuator& a,
                                      double force,
                                      const body::BodyState& state,
                                      std::vector<body::BodyWrench>& wrenches) {
  const body::BodyModel& model = *model_;
  const auto push = [&](body::BodyIndex body, const Vec3& p_B, const Vec3& f_G) {
    const Vec3 arm_G = state.X_GB[at(body)].R * p_B;
    wrenches.push_back({body, f_G, arm_G.cross(f_G)});
  };
  switch (a.kind) {
    case Actuator::Kind::muscle:
    case Actuator::Kind::path: {
      body::compute_path(model, path_of(model, a), state, workspace_, path_);
      for (std::size_t i = 0; i + 1 < workspace_.stations.size(); ++i) {
        const body::PathStation& here = workspace_.stations[i];
        const body::PathStation& next = workspace_.stations[i + 1];
        const Vec3 along = next.p_G - here.p_G;
        if (here.body == next.body || !(along.norm() > 0.0)) continue;
        const Vec3 f_G = force * along.normalized();
        push(here.body, here.p_B, f_G);
        push(next.body, next.p_B, -f_G);
      }
      break;
    }
    case Actuator::Kind::coordinate:
      break;
    case Actuator::Kind::point: {
      const body::PointActuator& p = model.point_actuators[a.index];
      const auto [station, direction] = line_of(p, state);
      push(p.body, station, force * direction);
      break;
    }
    case Actuator::Kind::torque: {
      const body::TorqueActuator& t = model.torque_actuators[a.index];
      const Vec3 m_G = force * axis_of(t, state);
      wrenches.push_back({t.body_a, Vec3::Zero(), m_G});
      wrenches.push_back({t.body_b, Vec3::Zero(), -m_G});
      break;
    }
  }
}

}  // namespace myoid::body
