#pragma once

#include <string>

#include "myoid/kinematics/joint_motion.h"
#include "myoid/model/body_model.h"

namespace myoid::dynamics {

/// Generalized forces that a motion requires: tau = M qddot + C(q, qdot) - gravity, one channel per
/// coordinate, in the model's order, [N m] for rotations, [N] for translations. Positive in the
/// coordinate's positive direction; what the muscles (and any device) must provide together.
[[nodiscard]] TimeSeries inverse_dynamics(const model::BodyModel& model,
                                          const kinematics::JointMotion& motion);

/// Column name of a coordinate's generalized force in files: "<coordinate>_moment", or "_force"
/// where it is not rotational.
[[nodiscard]] std::string generalized_force_name(const model::Coordinate& coordinate);

}  // namespace myoid::dynamics
