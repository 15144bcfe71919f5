#pragma once

#include <map>
#include <string>
#include <vector>

#include "myoid/kinematics/joint_motion.h"
#include "myoid/model/body_model.h"

namespace myoid::kinematics {

/// Muscles over time; channels are the muscles, in the model's order.
struct MuscleKinematics {
  TimeSeries length;    ///< Musculotendon length [m].
  TimeSeries velocity;  ///< dl/dt [m/s], lengthening positive.
  /// By coordinate, for every one that is not locked: r = -dl/dq [m], where coordinates that a
  /// constraint couples move along, as OpenSim defines it (coupling_matrix in model/constraints.h).
  std::map<std::string, TimeSeries> moment_arm;
};

/// Lengths, velocities and moment arms of all muscles along a motion. Parallel over frames; the
/// same for every number of threads.
[[nodiscard]] MuscleKinematics muscle_kinematics(const model::BodyModel& model,
                                                 const JointMotion& motion);

}  // namespace myoid::kinematics
