#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/body/dynamics/external_loads.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/geometry.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/recording/force_plate.h"
#include "myoid/study/intake/limits.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Distance from the center of pressure beyond which a marker does not stand on the plate.
inline constexpr double kFarFromPlate_m = kLimits.contacts.plate_far_m;

/// Returns the forces of plates on the bodies that stand on them, in the model's ground (R_YG from
/// the laboratory). Each plate acts with its force and its moment about the middle of its surface.
/// This equals force, center of pressure and free moment, but has no singularity without a load.
/// Where a plate does not bear the person (`recording::action_on_person`), force and moment are 0;
/// then all are low-passed forwards and backwards at `cutoff_hz`, if given.
/// `recording::stand_plates` must have found the plates' sides.
///
/// `bodies[k]` stands on plate k ("" on none). With an empty list each contact goes to the body whose marker is nearest
/// to its center of pressure, with a note. Throws InvalidInput for a body that the model does not have, more bodies
/// than plates, no plate, or a contact without a marker near it.
[[nodiscard]] body::ExternalLoads plate_loads(const std::vector<recording::ForcePlate>& plates,
                                              const Mat3& R_YG,
                                              const body::BodyModel& model,
                                              const std::vector<std::string>& bodies,
                                              const std::optional<MarkerSeries>& markers,
                                              double least_force_n,
                                              std::optional<double> cutoff_hz);

}  // namespace myoid::study
