#include "myoid/dynamics/inverse_dynamics.h"

#include <utility>
#include <vector>

#include "myoid/core/parallel.h"
#include "myoid/dynamics/passive_forces.h"
#include "myoid/kinematics/angular_speeds.h"
#include "myoid/model/kinematic_tree.h"

namespace myoid::dynamics {

TimeSeries inverse_dynamics(const model::BodyModel& model,
                            const kinematics::JointMotion& asked,
                            const InverseDynamicsOptions& options) {
  const bool by_speeds = kinematics::takes_rates_for_speeds(model);
  const kinematics::JointMotion motion = kinematics::moved_by_speeds(model, asked);
  const Eigen::Index frames = motion.sample_count();
  const auto count = static_cast<Eigen::Index>(model.coordinates.size());
  Eigen::MatrixXd tau(frames, count);
  const bool passive = options.passive_forces && !model.passive_forces.empty();
  parallel_ranges<Eigen::Index>(frames, 64, [&](const auto& range) {
    model::BodyState state = model::make_state(model);
    std::vector<model::BodyWrench> wrenches;
    Eigen::VectorXd generalized(count);
    for (Eigen::Index frame = range.begin(); frame != range.end(); ++frame) {
      const Eigen::VectorXd q = motion.q.values().row(frame).transpose();
      const Eigen::VectorXd qdot = motion.qdot.values().row(frame).transpose();
      wrenches.clear();
      generalized.setZero();
      if (options.loads != nullptr || passive) {
        model::compute_poses(model, q, state);
        model::compute_velocities(model, qdot, state);
      }
      if (options.loads != nullptr) options.loads->append_wrenches(state, motion.q.time_s()[frame], wrenches);
      if (passive) append_passive_forces(model, state, generalized, wrenches, motion.q.time_s()[frame]);
      Eigen::VectorXd moments =
          model::inverse_dynamics(model, q, qdot, motion.qddot.values().row(frame).transpose(), wrenches, state) -
          generalized;
      if (by_speeds) moments = kinematics::rates_of_speeds(model, q).transpose() * moments;
      tau.row(frame) = moments.transpose();
    }
  });
  std::vector<Channel> channels;
  for (const model::Coordinate& coordinate : model.coordinates) {
    channels.push_back({generalized_force_name(coordinate),
                        coordinate.motion == model::MotionType::translational ? Unit::newton : Unit::newton_meter});
  }
  return {motion.q.time_s(), std::move(channels), std::move(tau)};
}

std::string generalized_force_name(const model::Coordinate& coordinate) {
  return coordinate.name + (coordinate.motion == model::MotionType::rotational ? "_moment" : "_force");
}

}  // namespace myoid::dynamics
