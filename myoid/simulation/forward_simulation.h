#pragma once

#include "myoid/simulation/arm.h"
#include "myoid/simulation/simulation.h"

namespace myoid::simulation {

/// Integrates the arm's equations of motion from `start` to `options.end_s`; its one coordinate is elbow_flexion. If
/// all tendons are rigid, the method is explicit, otherwise implicit. Same input, same result. Throws InvalidInput if
/// arm, inputs or options cannot be used, and Interrupted on request; `status` reports a numerical failure.
[[nodiscard]] Simulation simulate(const Arm<double>& arm,
                                  const SimulationInput& input,
                                  const SimulationStart& start,
                                  const SimulationOptions& options);

}  // namespace myoid::simulation
