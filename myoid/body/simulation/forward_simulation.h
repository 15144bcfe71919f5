#pragma once

#include "myoid/body/simulation/simulation.h"
#include "myoid/body/simulation/simulation_model.h"

namespace myoid::body {

/// Integrates the model's equations of motion, M(q) qddot = R F_t + gravity - Coriolis + joints + external, from
/// `start` to `options.end_s`, with all coordinates in the model's order. If all tendons are rigid, the method is
/// explicit, otherwise implicit. Same input, same result. Dependent coordinates start where their couplers say. Throws
/// InvalidInput if inputs or options cannot be used or a device would move a dependent coordinate, ModelError if the
/// mass matrix of the free coordinates is not positive definite: a body has no mass. Throws Interrupted on request;
/// `status` reports a numerical failure.
[[nodiscard]] Simulation simulate(const SimulationModel& model,
                                  const SimulationInput& input,
                                  const SimulationStart& start,
                                  const SimulationOptions& options);

}  // namespace myoid::body
