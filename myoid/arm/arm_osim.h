#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/arm/arm4.h"
#include "myoid/core/units.h"

namespace myoid::model {

/// Elbow flexion at which the fibers of BIC, BRA, BRD and TRI are optimal.
inline constexpr std::array<double, 4> kArmOptimalAt_rad = {85.0 * kDegree, 75.0 * kDegree, 95.0 * kDegree,
                                                            60.0 * kDegree};

/// A muscle of the built-in arm in its model file.
struct MuscleText {
  PlanarMuscle path;
  muscle::HillParameters<double> hill;
  double pennation_at_optimal_rad = 0.0;
};

/// Returns the model file of the built-in skeleton with these muscles; see `arm4_osim`.
[[nodiscard]] std::string arm_osim(const Arm4Options& options,
                                   std::string_view name,
                                   const std::vector<MuscleText>& muscles);

}  // namespace myoid::model
