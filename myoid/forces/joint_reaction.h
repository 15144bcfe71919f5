#pragma once

#include <vector>

#include "myoid/forces/driven_frame.h"
#include "myoid/model/kinematic_tree.h"

namespace myoid::forces {

/// The loads of all joints at one instant.
struct JointLoads {
  std::vector<Pose> X_GB;                   ///< Pose of every body.
  std::vector<model::BodyWrench> on_child;  ///< Per joint, about the origin of the child's frame.
};

/// Returns the wrench of each joint's parent on its child under given forces. Posture and speeds are the motion's; the
/// forces make the accelerations (DrivenFrame), as in OpenSim's JointReaction. `forces` has a column for every actuator
/// of `actuators_of`, by name [N, N m], at the motion's times; an actuator without a column exerts nothing. The wrench
/// includes forces along the joint's own coordinates, also of couplers and locks; constraints that close a loop carry
/// their part of the load themselves. Parallel over frames. Throws as driven_accelerations.
[[nodiscard]] std::vector<JointLoads> joint_reactions(const model::BodyModel& model,
                                                      const kinematics::JointMotion& motion,
                                                      const TimeSeries& forces,
                                                      const DrivenOptions& options = {});

}  // namespace myoid::forces
