#pragma once

#include <vector>

#include "myoid/forces/driven_frame.h"
#include "myoid/model/kinematic_tree.h"

namespace myoid::forces {

/// What joints carry at one instant.
struct JointLoads {
  std::vector<Pose> X_GB;                   ///< Of every body.
  std::vector<model::BodyWrench> on_child;  ///< Per joint, about the origin of the child's frame.
};

/// What each joint's parent exerts on its child, muscles pulling as they are told: the posture and
/// speeds are the motion's, the accelerations those that the forces make (DrivenFrame), as in
/// OpenSim's JointReaction. `forces` has a column for every actuator of `actuators_of`, by name [N,
/// N m], at the motion's times; an actuator without one does nothing. Forces along a joint's own
/// coordinates, those of couplers and locks too, are part of what it carries; the constraints that
/// close a loop carry their part of the load themselves. Parallel over frames. Throws as
/// driven_accelerations.
[[nodiscard]] std::vector<JointLoads> joint_reactions(const model::BodyModel& model,
                                                      const kinematics::JointMotion& motion,
                                                      const TimeSeries& forces,
                                                      const DrivenOptions& options = {});

}  // namespace myoid::forces
