#include "myoid/dynamics/inverse_dynamics.h"

#include <utility>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/model/kinematic_tree.h"

namespace myoid::dynamics {

TimeSeries inverse_dynamics(const model::BodyModel& model, const kinematics::JointMotion& motion) {
  const Eigen::Index frames = motion.sample_count();
  Eigen::MatrixXd tau(frames, static_cast<Eigen::Index>(model.coordinates.size()));
  oneapi::tbb::parallel_for(
      oneapi::tbb::blocked_range<Eigen::Index>(0, frames, 128), [&](const auto& range) {
        model::BodyState state = model::make_state(model);
        for (Eigen::Index frame = range.begin(); frame != range.end(); ++frame) {
          tau.row(frame) =
              model::inverse_dynamics(model, motion.q.values().row(frame).transpose(),
                                      motion.qdot.values().row(frame).transpose(),
                                      motion.qddot.values().row(frame).transpose(), {}, state)
                  .transpose();
        }
      });
  std::vector<Channel> channels;
  for (const model::Coordinate& coordinate : model.coordinates) {
    channels.push_back(
        {generalized_force_name(coordinate), coordinate.motion == model::MotionType::translational
                                                 ? Unit::newton
                                                 : Unit::newton_meter});
  }
  return {motion.q.time_s(), std::move(channels), std::move(tau)};
}

std::string generalized_force_name(const model::Coordinate& coordinate) {
  return coordinate.name +
         (coordinate.motion == model::MotionType::rotational ? "_moment" : "_force");
}

}  // namespace myoid::dynamics
