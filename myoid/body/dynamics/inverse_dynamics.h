#pragma once

#include <string>

#include "myoid/body/dynamics/external_loads.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/model/body_model.h"

namespace myoid::body {

struct InverseDynamicsOptions {
  const ExternalLoads* loads = nullptr;  ///< Measured forces on bodies; not owned.
  bool passive_forces = false;           ///< Includes the model's limit forces, springs and ligaments.
};

/// Returns the generalized forces that a motion requires: tau = M qddot + C(q, qdot) - gravity -
/// external - passive, one channel per coordinate, in the model's order, [N m] for rotations, [N]
/// for translations. Positive in the coordinate's positive direction. Muscles and devices together
/// must provide these forces. Constraints are not projected: coupled and locked coordinates have a
/// force each. Parallel over frames, with equal results for every number of threads.
[[nodiscard]] TimeSeries inverse_dynamics(const body::BodyModel& model,
                                          const body::JointMotion& motion,
                                          const InverseDynamicsOptions& options = {});

/// Returns the column name of a coordinate's generalized force in files: "<coordinate>_moment" for
/// rotations, "<coordinate>_force" otherwise.
[[nodiscard]] std::string generalized_force_name(const body::Coordinate& coordinate);

}  // namespace myoid::body
