#include "myoid/body/dynamics/inverse_dynamics.h"

#include <utility>
#include <vector>

#include "myoid/body/dynamics/passive_forces.h"
#include "myoid/body/kinematics/angular_speeds.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/core/parallel.h"

namespace myoid::body {

TimeSeries inverse_dynamics(const body::BodyModel& model,
                            const body::JointMotion& asked,
                            const InverseDynamicsOptions& options) {
  const bool by_speeds = body::takes_rates_for_speeds(model);
  const body::JointMotion motion = body::moved_by_speeds(model, asked);
  const Eigen::Index frames = motion.sample_count();
  const auto count = static_cast<Eigen::Index>(model.coordinates.size());
  Eigen::MatrixXd tau(frames, count);
  const bool passive = options.passive_forces && !model.passive_forces.empty();
  parallel_ranges<Eigen::Index>(frames, 64, [&](const auto& range) {
    body::BodyState state = body::make_state(model);
    std::vector<body::BodyWrench> wrenches;
    Eigen::VectorXd generalized(count);
    for (Eigen::Index frame = range.begin(); frame != range.end(); ++frame) {
      const Eigen::VectorXd q = motion.q.values().row(frame).transpose();
      const Eigen::VectorXd qdot = motion.qdot.values().row(frame).transpose();
      wrenches.clear();
      generalized.setZero();
      if (options.loads != nullptr || passive) {
        body::compute_poses(model, q, state);
        body::compute_velocities(model, qdot, state);
      }
      if (options.loads != nullptr) options.loads->append_wrenches(state, motion.q.time_s()[frame], wrenches);
      if (passive) append_passive_forces(model, state, generalized, wrenches, motion.q.time_s()[frame]);
      Eigen::VectorXd moments =
          body::inverse_dynamics(model, q, qdot, motion.qddot.values().row(frame).transpose(), wrenches, state) -
          generalized;
      if (by_speeds) moments = body::rates_of_speeds(model, q).transpose() * moments;
      tau.row(frame) = moments.transpose();
    }
  });
  std::vector<Channel> channels;
  for (const body::Coordinate& coordinate : model.coordinates) {
    channels.push_back({generalized_force_name(coordinate),
                        coordinate.motion == body::MotionType::translational ? Unit::newton : Unit::newton_meter});
  }
  return {motion.q.time_s(), std::move(channels), std::move(tau)};
}

std::string generalized_force_name(const body::Coordinate& coordinate) {
  return coordinate.name + (coordinate.motion == body::MotionType::rotational ? "_moment" : "_force");
}

}  // namespace myoid::body
