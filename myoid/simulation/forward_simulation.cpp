#include "myoid/simulation/forward_simulation.h"

#include "myoid/simulation/hinge_skeleton.h"
#include "myoid/simulation/simulation_run.h"

namespace myoid::simulation {

Simulation simulate(const Arm<double>& arm,
                    const SimulationInput& input,
                    const SimulationStart& start,
                    const SimulationOptions& options) {
  validate(arm);
  const ArmDynamics<double> dynamics(arm);
  SimulationRun<HingeSkeleton> run(HingeSkeleton(dynamics), input, start, options);
  return run.go();
}

}  // namespace myoid::simulation
