#pragma once

#include <optional>

#include "myoid/model/path_stations.h"
#include "myoid/model/wrap_contact.h"

namespace myoid::model {

/// The contact of a straight piece from p to q with a wrap object, in the object's frame; empty if
/// it stays free.
[[nodiscard]] std::optional<WrapContact> contact_over(const WrapObject& object,
                                                      WrapMethod method,
                                                      const Vec3& p_W,
                                                      const Vec3& q_W);

/// One step of Newton's method towards where every tangent point is what its neighbors make of it;
/// `workspace.stations` hold the path. Nothing changes if a contact has been lost or the step is
/// not finite.
void refine_contacts(const BodyModel& model,
                     const MusclePath& path,
                     const BodyState& state,
                     PathWorkspace& workspace);

/// Adds to `arm` what the tangent points' own motion on their objects contributes to -dl/dq; the
/// path has come to rest. Zero where every contact is the shortest way over its object.
void add_contact_motion(const BodyModel& model,
                        const MusclePath& path,
                        const BodyState& state,
                        const std::vector<PathStation>& stations,
                        Eigen::VectorXd& arm);

/// The unit vector from one station to the next; zero where they coincide.
[[nodiscard]] Vec3 straight_direction(const PathStation& a, const PathStation& b);

}  // namespace myoid::model
