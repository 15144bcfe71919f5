#pragma once

#include <vector>

#include "myoid/body/dynamics/external_loads.h"
#include "myoid/body/dynamics/forward_dynamics.h"
#include "myoid/body/forces/actuator_columns.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/ground/core/progress.h"

namespace myoid::body {

/// The wrenches on a model and its accelerations, at one instant.
struct DrivenState {
  Eigen::VectorXd q;      ///< The motion's posture; meets the constraints.
  Eigen::VectorXd qddot;  ///< By forward dynamics with the constraints.
  /// All wrenches on bodies except gravity and the loads of joints: external loads, passive forces,
  /// actuators, and constraints that close loops.
  std::vector<body::BodyWrench> wrenches;
};

/// Accelerates a model by the forces of its actuators, its passive forces, `loads` and gravity, one
/// frame after the other; one per thread. The arguments must live as long.
class DrivenFrame {
 public:
  DrivenFrame(const body::BodyModel& model, const std::vector<Actuator>& actuators, const body::ExternalLoads* loads)
      : model_(model), actuators_(actuators), loads_(loads), dynamics_(model), columns_(model) {}

  /// Computes the state. `force`: one per actuator [N, N m]. Throws ModelError as
  /// body::ForwardDynamics.
  [[nodiscard]] DrivenState at_state(const Eigen::VectorXd& q,
                                     const Eigen::VectorXd& qdot,
                                     const Eigen::VectorXd& force,
                                     double time_s);

 private:
  const body::BodyModel& model_;
  const std::vector<Actuator>& actuators_;
  const body::ExternalLoads* loads_;
  body::ForwardDynamics dynamics_;
  ActuatorColumns columns_;
};

struct DrivenOptions {
  const body::ExternalLoads* loads = nullptr;  ///< Not owned.
  Progress progress{};
};

/// Returns the forces of all actuators of `actuators_of` at the motion's frames, by name: frames x actuators, 0 for an
/// actuator without a column. Throws InvalidInput if the number of frames differs.
[[nodiscard]] Eigen::MatrixXd force_rows(const std::vector<Actuator>& actuators,
                                         const body::JointMotion& motion,
                                         const TimeSeries& forces);

/// Returns the accelerations under these forces at the motion's postures and speeds [rad/s^2, m/s^2], one column a
/// coordinate: forward dynamics, which ignores the motion's own accelerations. Parallel over frames; the same for every
/// number of threads. Throws as DrivenFrame and force_rows.
[[nodiscard]] Eigen::MatrixXd driven_accelerations(const body::BodyModel& model,
                                                   const body::JointMotion& motion,
                                                   const TimeSeries& forces,
                                                   const DrivenOptions& options = {});

/// The loads of all joints at one instant.
struct JointLoads {
  std::vector<Pose> X_GB;                  ///< Pose of every body.
  std::vector<body::BodyWrench> on_child;  ///< Per joint, about the origin of the child's frame.
};

/// Returns the wrench of each joint's parent on its child under given forces. Posture and speeds are the motion's; the
/// forces make the accelerations (DrivenFrame), as in OpenSim's JointReaction. `forces` has a column for every actuator
/// of `actuators_of`, by name [N, N m], at the motion's times; an actuator without a column exerts nothing. The wrench
/// includes forces along the joint's own coordinates, also of couplers and locks; constraints that close a loop carry
/// their part of the load themselves. Parallel over frames. Throws as driven_accelerations.
[[nodiscard]] std::vector<JointLoads> joint_reactions(const body::BodyModel& model,
                                                      const body::JointMotion& motion,
                                                      const TimeSeries& forces,
                                                      const DrivenOptions& options = {});

}  // namespace myoid::body
