#include "myoid/body/forces/actuation.h"

#include <utility>

#include "myoid/body/forces/driven_frame.h"
#include "myoid/body/model/constraints.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/parallel.h"

namespace myoid::body {
namespace {

bool is_path(const Actuator& a) { return a.kind == Actuator::Kind::muscle || a.kind == Actuator::Kind::path; }

double opensim_point_speed(const body::PointActuator& p, const body::BodyState& state) {
  const Vec3 arm_G = state.X_GB[at(p.body)].R * p.point;
  return (state.v_GB[at(p.body)] + state.w_GB[at(p.body)].cross(arm_G)).norm();
}

double opensim_torque_speed(const body::TorqueActuator& t, const body::BodyState& state) {
  return t.axis.dot(state.w_GB[at(t.body_a)] - state.w_GB[at(t.body_b)]);
}

}  // namespace

Actuation actuation(const body::BodyModel& model,
                    const body::JointMotion& motion,
                    const TimeSeries& forces,
                    const ActuationOptions& options) {
  const std::vector<Actuator> actuators = actuators_of(model);
  const Eigen::MatrixXd force = force_rows(actuators, motion, forces);
  Eigen::MatrixXd speed(force.rows(), force.cols()), power(force.rows(), force.cols());
  parallel_ranges<Eigen::Index>(force.rows(), 8, [&](const auto& range) {
    body::BodyState state = body::make_state(model);
    ActuatorColumns columns(model);
    for (Eigen::Index i = range.begin(); i != range.end(); ++i) {
      options.progress.check();
      const Eigen::VectorXd qdot = motion.qdot.values().row(i).transpose();
      body::compute_poses(model, body::assemble(model, motion.q.values().row(i).transpose()).q, state);
      body::compute_velocities(model, qdot, state);
      for (Eigen::Index k = 0; k < force.cols(); ++k) {
        const Actuator& a = actuators[at(k)];
        const double rate = columns.of_unit_force(a, state).dot(qdot);
        if (is_path(a)) {
          speed(i, k) = columns.path().speed_mps;
        } else if (options.speeds_of_opensim && a.kind == Actuator::Kind::point) {
          speed(i, k) = opensim_point_speed(model.point_actuators[a.index], state);
        } else if (options.speeds_of_opensim && a.kind == Actuator::Kind::torque) {
          speed(i, k) = opensim_torque_speed(model.torque_actuators[a.index], state);
        } else {
          speed(i, k) = rate;
        }
        power(i, k) = (is_path(a) ? -1.0 : 1.0) * force(i, k) * speed(i, k);
      }
    }
  });
  std::vector<Channel> channels;
  for (const Actuator& a : actuators) channels.push_back({a.name, Unit::dimensionless});
  const Eigen::VectorXd& times = motion.q.time_s();
  return {{times, channels, std::move(speed)}, {times, channels, std::move(power)}};
}

}  // namespace myoid::body
