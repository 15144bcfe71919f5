#pragma once

#include "myoid/simulation/arm.h"
#include "myoid/simulation/simulation.h"

namespace myoid::simulation {

/// Integrates the arm's equations of motion from `start` to `options.end_s`; its one coordinate is
/// elbow_flexion. Muscles with rigid tendons alone make a problem for an explicit method, all
/// others for an implicit one. Same input, same result. Throws InvalidInput if arm, inputs or
/// options cannot be used, and Interrupted on request; a numerical failure is said by `status`.
[[nodiscard]] Simulation simulate(const Arm<double>& arm,
                                  const SimulationInput& input,
                                  const SimulationStart& start,
                                  const SimulationOptions& options);

}  // namespace myoid::simulation
