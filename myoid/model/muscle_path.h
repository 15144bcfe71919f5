#pragma once

#include <Eigen/Core>

#include "myoid/model/body_model.h"
#include "myoid/model/kinematic_tree.h"

namespace myoid::model {

/// A muscle at one posture.
struct PathResult {
  double length_m = 0.0;         ///< Musculotendon length.
  double speed_mps = 0.0;        ///< dl/dt at state.qdot, lengthening positive.
  Eigen::VectorXd moment_arm_m;  ///< r = -dl/dq per coordinate; torque = r times tendon force.
  bool wrapped = false;          ///< It lies on a wrap object.
};

/// Length of a muscle's path from origin to insertion through the points that are active at this
/// posture and around its wrap objects, with the exact derivatives: r_k = -sum over the straight
/// pieces of u . (dp_end/dq_k - dp_begin/dq_k), u the unit vector along the piece, tangent points
/// held on their object. A moving point's location is taken within its coordinate's range, where
/// its derivative is zero beyond. Over an ellipsoid the path is OpenSim's, which is not the
/// shortest (wrap_ellipsoid.h): there r is the moment of the unit tension, as OpenSim's, and
/// differs from -dl/dq by some tenths of a millimeter. `speed_mps` is -r . qdot. `compute_poses`
/// (and for the speed `compute_velocities`) must have been called on the state.
[[nodiscard]] PathResult compute_path(const BodyModel& model, int muscle, const BodyState& state);

}  // namespace myoid::model
