#pragma once

#include <optional>

#include "myoid/model/body_model.h"
#include "myoid/model/wrap_contact.h"

namespace myoid::model {

/// Returns the path from p to q through the ring of a torus: around a cylinder of the tube's radius that touches the
/// ring's circle where the straight piece comes nearest to it, on the side of the ring's middle. (OpenSim's
/// construction, with the correct nearest point.) With a quadrant only points of the circle nearest to that side count.
/// The cylinder moves with p and q, so -dl/dq differs from the moment of the unit tension. `T` = Jet6 gives the
/// derivatives by both ends. Empty: no contact.
template <typename T>
[[nodiscard]] std::optional<ContactOf<T>> wrap_torus(const TorusShape& torus,
                                                     Quadrant quadrant,
                                                     const Vector3<T>& p_W,
                                                     const Vector3<T>& q_W);

/// Returns the frame of the cylinder that replaces the tube between p and q, in the torus's frame:
/// z along the tube, x to the middle of the ring. Empty: no point of the circle counts.
[[nodiscard]] std::optional<Pose> torus_tube(const TorusShape& torus,
                                             Quadrant quadrant,
                                             const Vec3& p_W,
                                             const Vec3& q_W);

}  // namespace myoid::model
