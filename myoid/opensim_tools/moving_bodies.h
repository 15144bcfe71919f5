#pragma once

#include "myoid/kinematics/joint_motion.h"
#include "myoid/model/body_accelerations.h"
#include "myoid/model/body_model.h"
#include "myoid/model/kinematic_tree.h"

namespace myoid {

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
  [[nodiscard]] model::PointMotion point(std::size_t body, const Vec3& p_B) const {
    return acceleration_.of_station(state_, static_cast<model::BodyIndex>(body), p_B);
  }
  /// Returns the mass center of a body.
  [[nodiscard]] model::PointMotion center(std::size_t body) const { return point(body, model_.bodies[body].p_BBcm_B); }
  [[nodiscard]] model::PointMotion center_of_all() const;

 private:
  const model::BodyModel& model_;
  const kinematics::JointMotion& motion_;
  const Eigen::MatrixXd* qddot_;
  model::BodyState state_;
  model::BodyAccelerations acceleration_;
};

}  // namespace myoid
