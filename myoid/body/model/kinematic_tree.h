#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/geometry.h"

namespace myoid::body {

/// A model at one posture: one per thread, reused from frame to frame without allocation.
struct BodyState {
  Eigen::VectorXd q;       ///< Coordinates [rad | m].
  Eigen::VectorXd qdot;    ///< Their rates.
  std::vector<Pose> X_GB;  ///< Pose of each body in ground.
  std::vector<Vec3> w_GB;  ///< Angular velocity of each body, expressed in ground [rad/s].
  std::vector<Vec3> v_GB;  ///< Velocity of each body's origin, expressed in ground [m/s].
  /// Columns of the geometric Jacobian: per coordinate the angular velocity H_w and the velocity of the child frame's
  /// origin that unit speed gives the child body of its joint, expressed in ground.
  std::vector<Vec3> H_w_G;
  std::vector<Vec3> H_v_G;  ///< Velocity of the *child body's origin*.
};

[[nodiscard]] BodyState make_state(const BodyModel& model);

/// Fills X_GB and the Jacobian columns from q. Throws InvalidInput if q has the wrong size.
void compute_poses(const BodyModel& model, const Eigen::Ref<const Eigen::VectorXd>& q, BodyState& state);

/// Fills w_GB, v_GB from qdot; compute_poses must have been called for the same q.
void compute_velocities(const BodyModel& model, const Eigen::Ref<const Eigen::VectorXd>& qdot, BodyState& state);

/// Returns the Jacobian of the ground position of point p_BP fixed in `body` by all coordinates: 3 x nq.
[[nodiscard]] Eigen::Matrix3Xd station_jacobian(const BodyModel& model,
                                                const BodyState& state,
                                                BodyIndex body,
                                                const Vec3& p_BP);

/// Returns the angular velocity of a body per rate of each coordinate: 3 x nq.
[[nodiscard]] Eigen::Matrix3Xd angular_jacobian(const BodyModel& model, const BodyState& state, BodyIndex body);

/// Returns the velocity of the body's point at a place in ground.
[[nodiscard]] Vec3 point_velocity(const BodyState& state, BodyIndex body, const Vec3& p_G);

/// Force and moment on a body, applied at its origin, expressed in ground.
struct BodyWrench {
  BodyIndex body = 0;
  Vec3 f_G = Vec3::Zero();  ///< [N]
  Vec3 m_G = Vec3::Zero();  ///< [N m], about the body's origin.
};

/// Returns the wrench on a body of a force at a point of ground.
[[nodiscard]] BodyWrench wrench_at(const BodyState& state, BodyIndex body, const Vec3& p_G, const Vec3& f_G);

/// Returns the generalized forces tau that produce qddot at (q, qdot) under gravity and `external`,
/// by recursive Newton-Euler: tau = M qddot + C - gravity - external. Coordinates in model order,
/// [N m] or [N]. `carried`, if given, receives for every body the wrench that its joint transmits
/// from the parent, with the forces along the joint's coordinates.
[[nodiscard]] Eigen::VectorXd inverse_dynamics(const BodyModel& model,
                                               const Eigen::Ref<const Eigen::VectorXd>& q,
                                               const Eigen::Ref<const Eigen::VectorXd>& qdot,
                                               const Eigen::Ref<const Eigen::VectorXd>& qddot,
                                               const std::vector<BodyWrench>& external,
                                               BodyState& state,
                                               std::vector<BodyWrench>* carried = nullptr);

/// Returns the joint-space mass matrix, nq x nq.
[[nodiscard]] Eigen::MatrixXd mass_matrix(const BodyModel& model,
                                          const Eigen::Ref<const Eigen::VectorXd>& q,
                                          BodyState& state);

}  // namespace myoid::body
