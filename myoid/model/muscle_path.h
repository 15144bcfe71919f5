#pragma once

#include "myoid/model/path_stations.h"

namespace myoid::model {

/// Length of a path from its first point to its last through the points that are active at this
/// posture and around its wrap objects, with the derivatives by every coordinate on its own.
///
/// `exact` (BodyModel::compat without switches): r = -dl/dq of this very length. Over cylinders and
/// spheres the path is the shortest, and r the moment of the unit tension along the straight
/// pieces; over an ellipsoid or a torus it is OpenSim's construction, which is not the shortest,
/// and the tangent points' own motion counts too. A moving point's location is taken within its
/// coordinate's range, where its derivative is zero beyond. `speed_mps` is -r . qdot.
///
/// With Compat::opensim_paths all is as OpenSim 4.5.2 computes it (compat.h): r the moments of the
/// unit tension, speed from the velocities of the points.
///
/// A path given by functions has no stations; its speed is -r . qdot.
///
/// `compute_poses` (and for the speed `compute_velocities`) must have been called on the state.
void compute_path(const BodyModel& model,
                  const MusclePath& path,
                  const BodyState& state,
                  PathWorkspace& workspace,
                  PathResult& result);
[[nodiscard]] PathResult compute_path(const BodyModel& model, int muscle, const BodyState& state);

}  // namespace myoid::model
