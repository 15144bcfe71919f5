#pragma once

#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/recording/force_plate.h"
#include "myoid/recording/signals/quality_limits.h"

namespace myoid::recording {

/// Checks one force plate after `recording::stand_plates`:
///
/// - offset: the mean force along the normal over the fifth of a second in which it is smallest, if it is steady there
///   (standard deviation below 5 N) and below 80 N; a larger force is a person who never left the plate;
/// - sign: the file holds the force on the plate (a remark, because readers of plates invert it);
/// - center of pressure outside the corners under load.
[[nodiscard]] std::vector<Remark> check_force_plate(const recording::ForcePlate& plate);

/// Checks the center of pressure alone, for a command whose reader tells the rest.
[[nodiscard]] std::vector<Remark> check_plate_pressure(const recording::ForcePlate& plate);

}  // namespace myoid::recording
