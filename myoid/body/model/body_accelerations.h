#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/core/geometry.h"

namespace myoid::body {

/// Place [m], velocity [m/s] and acceleration [m/s^2] of a point, in ground.
struct PointMotion {
  Vec3 p = Vec3::Zero(), v = Vec3::Zero(), a = Vec3::Zero();
};

/// Accelerations of every body, expressed in ground; [0] is ground.
struct BodyAccelerations {
  std::vector<Vec3> alpha_GB;  ///< Angular [rad/s^2].
  std::vector<Vec3> a_GB;      ///< Acceleration of the body's origin [m/s^2].

  /// Returns the motion of a point fixed in a body.
  [[nodiscard]] PointMotion of_station(const BodyState& state, BodyIndex body, const Vec3& p_BP) const;
};

/// Computes the accelerations of all bodies from qddot, from the ground outward:
///   alpha_B = alpha_P + w_P x w_rel + alpha_rel,
///   a_M = a_P + alpha_P x r + w_P x (w_P x r) + 2 w_P x v_rel + a_rel.
/// `compute_poses` and `compute_velocities` must have been called on `state`. `a_ground` is added
/// to every body; minus gravity gives the accelerations that an accelerometer measures.
void compute_accelerations(const BodyModel& model,
                           const Eigen::Ref<const Eigen::VectorXd>& qddot,
                           const BodyState& state,
                           BodyAccelerations& result,
                           const Vec3& a_ground = Vec3::Zero());

}  // namespace myoid::body
