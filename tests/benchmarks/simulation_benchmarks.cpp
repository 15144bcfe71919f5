// Ten simulated seconds of the four-muscle arm. Figures and command: docs/data/timings.txt.
#include <benchmark/benchmark.h>

#include "myoid/simulation/arm_model.h"
#include "myoid/simulation/forward_simulation.h"
#include "myoid/simulation/sensitivity.h"

namespace {

using namespace myoid;

/// Flexors and extensor in turn, once a second, over a little co-contraction.
simulation::SimulationInput bursting() {
  std::vector<simulation::Burst> flex;
  std::vector<simulation::Burst> extend;
  for (int k = 0; k < 10; ++k) {
    flex.push_back({0.2 + k, 0.25, 0.3});
    extend.push_back({0.6 + k, 0.25, 0.2});
  }
  const simulation::Signal flexor = simulation::bursts(flex, 0.02);
  return {.excitation = {flexor, flexor, flexor, simulation::bursts(extend, 0.02)}};
}

simulation::SimulationModel arm_in(muscle::TendonMode mode) {
  simulation::ArmSetup setup;
  setup.model.mode = mode;
  return simulation::make_arm_model(setup);
}

/// range(0): the tendon mode; range(1): with the work of every element.
void simulate_arm(benchmark::State& state) {
  const auto mode = static_cast<muscle::TendonMode>(state.range(0));
  const simulation::SimulationModel arm = arm_in(mode);
  const simulation::SimulationInput input = bursting();
  simulation::SimulationOptions options{.end_s = 10.0, .output_rate_hz = 100.0};
  options.energy = state.range(1) != 0;
  for (auto _ : state) benchmark::DoNotOptimize(simulation::simulate(arm, input, {.q = {1.0}}, options));
}
BENCHMARK(simulate_arm)
    ->Args({0, 0})
    ->Args({1, 0})
    ->Args({2, 0})
    ->Args({0, 1})
    ->Args({1, 1})
    ->Args({2, 1})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

/// One second, derivatives by eight parameters.
void simulate_arm_sensitivities(benchmark::State& state) {
  const auto mode = static_cast<muscle::TendonMode>(state.range(0));
  const simulation::SimulationModel arm = arm_in(mode);
  const std::vector<std::string> names = {
      "BIC.max_isometric_force", "BIC.optimal_fiber_length", "BIC.concentric_curvature", "BIC.tendon_slack_length",
      "TRI.max_isometric_force", "TRI.optimal_fiber_length", "TRI.concentric_curvature", "TRI.tendon_slack_length"};
  const simulation::SimulationInput input = bursting();
  const simulation::SimulationOptions options{.end_s = 1.0, .output_rate_hz = 100.0};
  for (auto _ : state) {
    benchmark::DoNotOptimize(simulation::simulate_sensitivities(arm, input, {.q = {1.0}}, options, names));
  }
}
BENCHMARK(simulate_arm_sensitivities)->Arg(0)->Arg(1)->Arg(2)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
