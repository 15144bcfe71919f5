#pragma once

#include <vector>

#include "myoid/core/geometry.h"
#include "myoid/recording/force_plate.h"
#include "myoid/signals/fault.h"
#include "myoid/signals/quality_limits.h"

namespace myoid::signals {

/// Looks at one force plate in a laboratory whose vertical is `up_G` (a unit vector):
///
/// - offset: the mean vertical force over the fifth of a second in which it is smallest, where that
///   is steady (standard deviation below 5 N) and below 80 N; more is a person who never left;
/// - sign: the largest force points down;
/// - center of pressure outside the corners while loaded.
[[nodiscard]] std::vector<Fault> check_force_plate(const recording::ForcePlate& plate,
                                                   const Vec3& up_G,
                                                   const QualityLimits& limits = {});

}  // namespace myoid::signals
