#pragma once

#include <vector>

#include "myoid/body/simulation/simulation.h"
#include "myoid/body/simulation/simulation_model.h"

namespace myoid::body {

/// Throws InvalidInput unless start, input and options fit the model.
void check_simulation(const SimulationModel& model,
                      const SimulationInput& input,
                      const SimulationStart& start,
                      const SimulationOptions& options);

/// Returns the start with dependent coordinates where their couplers say.
[[nodiscard]] SimulationStart consistent_start(const SimulationModel& model, const SimulationStart& start);

/// Returns the times of the result's rows.
[[nodiscard]] std::vector<double> output_times(const SimulationStart& start, const SimulationOptions& options);

/// Returns the times after `start_s` at which inputs jump, and the end, in order.
[[nodiscard]] std::vector<double> break_times(const SimulationInput& input,
                                              double start_s,
                                              const SimulationOptions& options);

}  // namespace myoid::body
