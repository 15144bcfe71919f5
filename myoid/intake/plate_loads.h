#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/core/geometry.h"
#include "myoid/dynamics/external_loads.h"
#include "myoid/files/marker_series.h"
#include "myoid/intake/limits.h"
#include "myoid/model/body_model.h"
#include "myoid/recording/force_plate.h"
#include "myoid/study/study.h"

namespace myoid {

/// A marker farther than this from the center of pressure does not stand on the plate.
inline constexpr double kFarFromPlate_m = kLimits.plate_far_m;

/// What force plates do to the bodies that stand on them, in the model's ground (R_YG from the
/// laboratory). Each plate acts with its force and its moment about the middle of its surface,
/// which is the same as force, center of pressure and free moment, and has no pole where nobody
/// stands on it. Where a plate does not bear the person (`recording::action_on_person`) it is 0;
/// then everything is low-passed forwards and backwards at `cutoff_hz`, if given. The plates' sides
/// are those that `recording::stand_plates` found.
///
/// `bodies[k]` stands on plate k ("" on none); with an empty list each contact goes to the body
/// whose marker is nearest to its center of pressure, with a note. Throws InvalidInput: a body that
/// the model does not have, more bodies than plates, no plate at all, or a contact that no marker
/// is near.
[[nodiscard]] dynamics::ExternalLoads plate_loads(
    const std::vector<recording::ForcePlate>& plates,
    const Mat3& R_YG,
    const model::BodyModel& model,
    const std::vector<std::string>& bodies,
    const std::optional<recording::MarkerSeries>& markers,
    double least_force_n,
    std::optional<double> cutoff_hz);

}  // namespace myoid
