#pragma once

#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {

/// Returns the path of a muscle as a line to draw: its stations in ground [m] and points of its arcs over the wrap
/// objects. The line turns by at most `most_turn_rad` from one piece to the next (measured on a circle or sphere of
/// radius one). Its length approaches the length of the path from below, with the square of `most_turn_rad`.
///
/// `stations` come from the workspace of `compute_path` at this posture. Over a cylinder the curve
/// is the helix, over a sphere the great circle, over an ellipsoid the cut by the plane of the
/// adjoining straight pieces, through a torus the helix around the tube. A straight piece replaces
/// the curve between tangent points of OpenSim's paths (compat.h) that lie on no such curve.
[[nodiscard]] std::vector<Vec3> path_polyline(const BodyModel& model,
                                              const MusclePath& path,
                                              const BodyState& state,
                                              const std::vector<PathStation>& stations,
                                              double most_turn_rad = 10.0 * kDegree);

}  // namespace myoid::body
