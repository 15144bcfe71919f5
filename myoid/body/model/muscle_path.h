#pragma once

#include "myoid/body/model/path_stations.h"

namespace myoid::body {

/// Computes the length of a path from its first point to its last through the points that are active at this posture
/// and around its wrap objects, with the derivatives by every coordinate alone.
///
/// `exact` (BodyModel::compat without switches): r = -dl/dq of this length. Over cylinders and spheres the path is the
/// shortest, and r is the moment of the unit tension along the straight pieces. Over an ellipsoid or a torus the path
/// follows OpenSim's construction, which is not the shortest, and r also counts the motion of the tangent points on the
/// object. A moving point's location is taken within the range of its coordinate; its derivative is zero beyond.
/// `speed_mps` is -r . qdot.
///
/// Compat::opensim_paths: as in OpenSim 4.5.2 (compat.h), r is the moment of the unit tension, and
/// the speed follows from the velocities of the points.
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

}  // namespace myoid::body
