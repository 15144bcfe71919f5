#pragma once

#include <vector>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"

namespace myoid::body {

/// Adds the model's passive forces (limit forces, springs, bushings, formulas, ligaments, contacts, forces over time)
/// at the posture and speeds of `state` (compute_poses, compute_velocities) and at this time. `generalized` receives
/// forces along coordinates [N m, N], `wrenches` forces on bodies, about the body origins. Where
/// OpenSim's speeds differ from rates (body/kinematics/angular_speeds.h), springs and limits of a coordinate act on its
/// speed.
void append_passive_forces(const body::BodyModel& model,
                           const body::BodyState& state,
                           Eigen::VectorXd& generalized,
                           std::vector<body::BodyWrench>& wrenches,
                           double time_s = 0.0);

/// Returns the generalized force of OpenSim's CoordinateLimitForce at q and its rate:
///   -K_up (q - q_up) + K_low (q_low - q) - c (K_up/k_up + K_low/k_low) qdot,
/// K rising from 0 at the limit to its stiffness k over `transition`, as 10 s^3 - 15 s^4 + 6 s^5.
[[nodiscard]] double limit_force(const body::CoordinateLimitForce& force, double q, double qdot);

}  // namespace myoid::body
