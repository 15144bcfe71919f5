#include "myoid/opensim_tools/moving_bodies.h"

#include "myoid/model/constraints.h"

namespace myoid {

MovingBodies::MovingBodies(const model::BodyModel& model,
                           const kinematics::JointMotion& motion,
                           const Eigen::MatrixXd* qddot)
    : model_(model), motion_(motion), qddot_(qddot), state_(model::make_state(model)) {}

void MovingBodies::set(Eigen::Index row) {
  const auto& q = motion_.q.values();
  model::compute_poses(model_, model::assemble(model_, q.row(row).transpose()).q, state_);
  model::compute_velocities(model_, motion_.qdot.values().row(row).transpose(), state_);
  const Eigen::VectorXd qddot =
      qddot_ != nullptr ? Eigen::VectorXd(qddot_->row(row).transpose()) : Eigen::VectorXd::Zero(q.cols());
  model::compute_accelerations(model_, qddot, state_, acceleration_);
}

model::PointMotion MovingBodies::center_of_all() const {
  double mass_kg = 0.0;
  model::PointMotion sum;
  for (std::size_t b = 1; b < model_.bodies.size(); ++b) {
    const double m = model_.bodies[b].mass_kg;
    const model::PointMotion c = center(b);
    mass_kg += m;
    sum = {sum.p + m * c.p, sum.v + m * c.v, sum.a + m * c.a};
  }
  return {sum.p / mass_kg, sum.v / mass_kg, sum.a / mass_kg};
}

}  // namespace myoid
