#pragma once

#include <vector>

#include "myoid/core/remark.h"
#include "myoid/recording/force_plate.h"
#include "myoid/signals/quality_limits.h"

namespace myoid::signals {

/// Looks at one force plate, whose side `recording::stand_plates` has found:
///
/// - offset: the mean force along the normal over the fifth of a second in which it is smallest,
///   where that is steady (standard deviation below 5 N) and below 80 N; more is a person who never
///   left;
/// - sign: the file holds the force on the plate (a remark: whoever reads plates turns it round);
/// - center of pressure outside the corners while loaded.
[[nodiscard]] std::vector<Remark> check_force_plate(const recording::ForcePlate& plate,
                                                    const QualityLimits& limits = {});

}  // namespace myoid::signals
