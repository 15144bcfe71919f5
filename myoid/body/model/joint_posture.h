#pragma once

#include <array>

#include <Eigen/Core>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/geometry.h"

namespace myoid::body {

/// A joint at one posture.
struct JointPosture {
  Pose X_FM;
  std::array<Vec3, 3> axis_F;          ///< Each axis of rotation, turned into F.
  std::array<FunctionValue, 3> angle;  ///< [rad] and its derivatives by the axis's coordinate.
  std::array<FunctionValue, 3> shift;  ///< [m] and its derivatives by the axis's coordinate.
};

[[nodiscard]] JointPosture joint_posture(const Joint& joint, const Eigen::Ref<const Eigen::VectorXd>& q);

/// Motion of M in F, expressed in F, with the accelerations by `qddot` and the rates.
struct RelativeMotion {
  Vec3 w = Vec3::Zero();      ///< Angular velocity [rad/s].
  Vec3 v = Vec3::Zero();      ///< Velocity of M's origin [m/s].
  Vec3 alpha = Vec3::Zero();  ///< Angular acceleration [rad/s^2].
  Vec3 a = Vec3::Zero();      ///< Acceleration of M's origin [m/s^2].
};

/// Returns the motion. With `by_coordinates` the axes of rotation turn by OpenSim's rule
/// (Compat::axes_carried_by_coordinates), otherwise with the rotations before them.
[[nodiscard]] RelativeMotion relative_motion(const Joint& joint,
                                             bool by_coordinates,
                                             const JointPosture& p,
                                             const Eigen::Ref<const Eigen::VectorXd>& qdot,
                                             const Eigen::Ref<const Eigen::VectorXd>& qddot);

}  // namespace myoid::body
