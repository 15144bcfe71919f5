#pragma once

#include <vector>

#include "myoid/core/progress.h"
#include "myoid/dynamics/external_loads.h"
#include "myoid/kinematics/joint_motion.h"
#include "myoid/model/kinematic_tree.h"

namespace myoid::forces {

struct JointReactionOptions {
  const dynamics::ExternalLoads* loads = nullptr;  ///< Not owned.
  Progress progress{};
};

/// What joints carry at one instant.
struct JointLoads {
  std::vector<Pose> X_GB;                   ///< Of every body.
  std::vector<model::BodyWrench> on_child;  ///< Per joint, about the origin of the child's frame.
};

/// What each joint's parent exerts on its child, muscles pulling as they are told: the posture and
/// speeds are the motion's, the accelerations those that the forces make (forward dynamics,
/// couplers and locks kept), as in OpenSim's JointReaction. `forces` has a column for every
/// actuator of `actuators_of`, by name [N, N m], at the motion's times; an actuator without one
/// does nothing. What acts along a joint's own coordinates is part of what it carries. Throws
/// ModelError for a model with closed loops (constraints other than couplers), InvalidInput if the
/// times differ. Parallel over frames.
[[nodiscard]] std::vector<JointLoads> joint_reactions(const model::BodyModel& model,
                                                      const kinematics::JointMotion& motion,
                                                      const TimeSeries& forces,
                                                      const JointReactionOptions& options = {});

}  // namespace myoid::forces
