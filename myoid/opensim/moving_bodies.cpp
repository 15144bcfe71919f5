#include "myoid/opensim/moving_bodies.h"

#include "myoid/body/model/constraints.h"

namespace myoid::opensim {

MovingBodies::MovingBodies(const body::BodyModel& model, const body::JointMotion& motion, const Eigen::MatrixXd* qddot)
    : model_(model), motion_(motion), qddot_(qddot), state_(body::make_state(model)) {}

void MovingBodies::set(Eigen::Index row) {
  const auto& q = motion_.q.values();
  body::compute_poses(model_, body::assemble(model_, q.row(row).transpose()).q, state_);
  body::compute_velocities(model_, motion_.qdot.values().row(row).transpose(), state_);
  const Eigen::VectorXd qddot =
      qddot_ != nullptr ? Eigen::VectorXd(qddot_->row(row).transpose()) : Eigen::VectorXd::Zero(q.cols());
  body::compute_accelerations(model_, qddot, state_, acceleration_);
}

body::PointMotion MovingBodies::center_of_all() const {
  double mass_kg = 0.0;
  body::PointMotion sum;
  for (std::size_t b = 1; b < model_.bodies.size(); ++b) {
    const double m = model_.bodies[b].mass_kg;
    const body::PointMotion c = center(b);
    mass_kg += m;
    sum = {sum.p + m * c.p, sum.v + m * c.v, sum.a + m * c.a};
  }
  return {sum.p / mass_kg, sum.v / mass_kg, sum.a / mass_kg};
}

}  // namespace myoid::opensim
