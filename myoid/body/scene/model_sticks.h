#pragma once

#include <array>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/geometry.h"

namespace myoid::body {

/// Ends of the sticks that stand for a body's bones, in the body.
using BodySticks = std::vector<std::array<Vec3, 2>>;

/// Returns sticks for every body of a model but ground: from the body's own joint to each joint of
/// its children, where these are in the default posture; a joint much nearer to the joint of a
/// heavier sibling (a patella beside the knee) hangs on the sibling's. A body without children
/// reaches to its mass center, or on to its farthest marker or muscle point in that direction.
[[nodiscard]] std::vector<BodySticks> body_sticks(const body::BodyModel& model);

}  // namespace myoid::body
