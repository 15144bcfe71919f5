#pragma once

#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/model/body_accelerations.h"
#include "myoid/body/model/body_model.h"
#include "myoid/body/model/kinematic_tree.h"

namespace myoid::opensim {

/// The bodies of a model along a motion, one frame at a time. The postures obey the constraints.
class MovingBodies {
 public:
  /// `qddot` holds rows x coordinates [rad/s^2, m/s^2]; without it all accelerations are computed
  /// from zero rates of the speeds. Model, motion and `qddot` must outlive the object.
  MovingBodies(const body::BodyModel& model, const body::JointMotion& motion, const Eigen::MatrixXd* qddot = nullptr);

  /// Moves the bodies to a row of the motion.
  void set(Eigen::Index row);
  [[nodiscard]] const body::BodyState& state() const { return state_; }
  [[nodiscard]] const Pose& pose(std::size_t body) const { return state_.X_GB[body]; }
  [[nodiscard]] const Vec3& angular_velocity(std::size_t body) const { return state_.w_GB[body]; }
  [[nodiscard]] const Vec3& angular_acceleration(std::size_t body) const { return acceleration_.alpha_GB[body]; }
  [[nodiscard]] body::PointMotion point(std::size_t body, const Vec3& p_B) const {
    return acceleration_.of_station(state_, static_cast<body::BodyIndex>(body), p_B);
  }
  /// Returns the mass center of a body.
  [[nodiscard]] body::PointMotion center(std::size_t body) const { return point(body, model_.bodies[body].p_BBcm_B); }
  [[nodiscard]] body::PointMotion center_of_all() const;

 private:
  const body::BodyModel& model_;
  const body::JointMotion& motion_;
  const Eigen::MatrixXd* qddot_;
  body::BodyState state_;
  body::BodyAccelerations acceleration_;
};

}  // namespace myoid::opensim
