#pragma once

#include "myoid/kinematics/joint_motion.h"
#include "myoid/model/body_accelerations.h"
#include "myoid/model/body_model.h"
#include "myoid/model/kinematic_tree.h"

namespace myoid {

/// Place [m], velocity [m/s] and acceleration [m/s^2] of a point, in ground.
struct PointMotion {
  Vec3 p = Vec3::Zero(), v = Vec3::Zero(), a = Vec3::Zero();
};

/// The bodies of a model along a motion, one frame at a time. The postures obey the constraints.
class MovingBodies {
 public:
  /// `qddot` holds rows x coordinates [rad/s^2, m/s^2]; without it all accelerations are computed
  /// from zero rates of the speeds. Model, motion and `qddot` must outlive the object.
  MovingBodies(const model::BodyModel& model,
               const kinematics::JointMotion& motion,
               const Eigen::MatrixXd* qddot = nullptr);

  /// Moves the bodies to a row of the motion.
  void set(Eigen::Index row);
  [[nodiscard]] const model::BodyState& state() const { return state_; }
  [[nodiscard]] const Pose& pose(std::size_t body) const { return state_.X_GB[body]; }
  [[nodiscard]] const Vec3& angular_velocity(std::size_t body) const { return state_.w_GB[body]; }
  [[nodiscard]] const Vec3& angular_acceleration(std::size_t body) const { return acceleration_.alpha_GB[body]; }
  [[nodiscard]] PointMotion point(std::size_t body, const Vec3& p_B) const;
  /// Returns the mass center of a body.
  [[nodiscard]] PointMotion center(std::size_t body) const;
  [[nodiscard]] PointMotion center_of_all() const;

 private:
  const model::BodyModel& model_;
  const kinematics::JointMotion& motion_;
  const Eigen::MatrixXd* qddot_;
  model::BodyState state_;
  model::BodyAccelerations acceleration_;
};

}  // namespace myoid
