#pragma once

#include <filesystem>
#include <optional>

#include "myoid/ground/core/geometry.h"
#include "myoid/recording/force_plate.h"
#include "myoid/recording/laboratory_up.h"
#include "myoid/recording/recorded_trial.h"

namespace myoid::recording {

/// Finds which way is up in the laboratory (`stated_up_L`, else `laboratory_up`), on which side of each plate the
/// person is, and whether its channels hold the force on the person. Fills `side` of each plate and inverts an ORIGIN
/// that points away from the person, with notes in `recording.repairs`. Throws InvalidInput as `laboratory_up`.
///
/// A plate of the floor can only push the person up: its force is inverted if its weighted mean along the normal points
/// down. A wall or a handle has the sign of the floor's plates; without such plates it pushes the person away.
LaboratoryUp stand_plates(Recording& recording,
                          const std::optional<Vec3>& stated_up_L,
                          double least_force_n = kLeastForce_n);

/// Returns the upward axis of the laboratory as `stand_plates` finds it in a .c3d file; empty for
/// other formats. Throws ReadError where the file contradicts itself.
[[nodiscard]] LaboratoryUp read_laboratory_up(const std::filesystem::path& path);

}  // namespace myoid::recording
