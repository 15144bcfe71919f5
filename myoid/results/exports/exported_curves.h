#pragma once

#include <vector>

#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/opensim/projects/project.h"

namespace myoid::results {

/// Returns our laws of a muscle of unit force and length as tables of another program: active and passive force over
/// the fiber's length, force over velocity and, `with_tendon`, the tendon's force over its strain. `speed`: v_max over
/// the speed by which the table's velocities are normalised.
[[nodiscard]] std::vector<opensim::ProjectCurve> exported_curves(const fit::MuscleValues& unit,
                                                                 double speed,
                                                                 bool with_tendon);

}  // namespace myoid::results
