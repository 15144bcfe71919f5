#pragma once

#include <vector>

#include "myoid/core/geometry.h"
#include "myoid/core/units.h"
#include "myoid/model/body_model.h"
#include "myoid/model/kinematic_tree.h"
#include "myoid/model/muscle_path.h"

namespace myoid::model {

/// The path of a muscle as a line to draw: its stations in ground [m], and along each wrap object
/// points of the curve that the path's length counts, so close that the line turns by at most
/// `most_turn_rad` from one piece to the next (measured where the object is a circle or a sphere of
/// radius one). The line's length approaches the path's from below as `most_turn_rad` goes to zero,
/// with its square.
///
/// `stations` is what `compute_path` left in its workspace for this posture. Over a cylinder the
/// curve is the helix, over a sphere the great circle, over an ellipsoid the cut by the plane of
/// the adjoining straight pieces, through a torus the helix around the tube. Where OpenSim's way to
/// compute paths (compat.h) leaves tangent points that are on no such curve, a straight piece
/// stands in for it.
[[nodiscard]] std::vector<Vec3> path_polyline(const BodyModel& model,
                                              const MusclePath& path,
                                              const BodyState& state,
                                              const std::vector<PathStation>& stations,
                                              double most_turn_rad = 10.0 * kDegree);

}  // namespace myoid::model
