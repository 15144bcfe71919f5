#pragma once

#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"

namespace myoid::body {

/// Limits of the numbers of a model of a person or an animal.
struct ModelLimits {
  double heaviest_kg = 500.0;                        ///< No person weighs more.
  double lightest_kg = 0.1;                          ///< A model of a hand is heavier.
  double strongest_mps2 = 30.0, weakest_mps2 = 0.5;  ///< Gravity; 0 is a choice.
  /// Optimal fibers: those of a fly and of a giraffe.
  double shortest_fiber_m = 2e-4, longest_fiber_m = 1.0;
  double longest_tendon_m = 2.0;
  double strongest_muscle_n = 1e5;
  double farthest_point_m = 20.0;  ///< Of a path, from the origin of its frame; the ground's may be that of a room.
};
inline constexpr ModelLimits kModelLimits;

/// Returns the mass of all bodies [kg].
[[nodiscard]] double mass_kg(const BodyModel& model);

/// Finds masses, gravity, lengths of fibers and tendons, strengths and path points of muscles that no body has, as
/// numbers in other units are. Errors are numbers that make every torque wrong.
[[nodiscard]] std::vector<Remark> implausible(const BodyModel& model);

}  // namespace myoid::body
