#pragma once

#include <optional>

#include "myoid/body/model/path_stations.h"
#include "myoid/body/model/wrap_contact.h"

namespace myoid::body {

/// Returns the contact of a straight piece from p to q with a wrap object, in the object's frame;
/// empty without contact.
[[nodiscard]] std::optional<WrapContact> contact_over(const WrapObject& object,
                                                      WrapMethod method,
                                                      const Vec3& p_W,
                                                      const Vec3& q_W);

/// Takes one Newton step towards tangent points that each fit their neighbors. `workspace.stations`
/// hold the path; they stay unchanged if a contact is lost or the step is not finite.
void refine_contacts(const PosedPath& posed, PathWorkspace& workspace);

/// Adds to `arm` the share of -dl/dq that comes from the tangent points' motion on their objects. The path must be at
/// rest. The share is zero if every contact is the shortest way over its object.
void add_contact_motion(const PosedPath& posed, const std::vector<PathStation>& stations, Eigen::VectorXd& arm);

/// Returns the unit vector from one station to the next; zero if they coincide.
[[nodiscard]] Vec3 straight_direction(const PathStation& a, const PathStation& b);

}  // namespace myoid::body
