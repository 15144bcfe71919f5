// Ten simulated seconds of the four-muscle arm. Figures and command: docs/data/timings.txt.
#include <benchmark/benchmark.h>

#include "myoid/body/simulation/arm_model.h"
#include "myoid/body/simulation/forward_simulation.h"
#include "myoid/body/simulation/sensitivity.h"

namespace {

using namespace myoid;

/// Flexors and extensor in turn, once a second, over a little co-contraction.
body::SimulationInput bursting() {
  std::vector<body::Burst> flex;
  std::vector<body::Burst> extend;
  for (int k = 0; k < 10; ++k) {
    flex.push_back({0.2 + k, 0.25, 0.3});
    extend.push_back({0.6 + k, 0.25, 0.2});
  }
  const body::Signal flexor = body::bursts(flex, 0.02);
  return {.excitation = {flexor, flexor, flexor, body::bursts(extend, 0.02)}};
}

body::SimulationModel arm_in(muscle::TendonMode mode) {
  body::ArmSetup setup;
  setup.model.mode = mode;
  return body::make_arm_model(setup);
}

/// range(0): the tendon mode; range(1): with the work of every element.
void simulate_arm(benchmark::State& state) {
  const auto mode = static_cast<muscle::TendonMode>(state.range(0));
  const body::SimulationModel arm = arm_in(mode);
  const body::SimulationInput input = bursting();
  body::SimulationOptions options{.end_s = 10.0, .output_rate_hz = 100.0};
  options.energy = state.range(1) != 0;
  for (auto _ : state) benchmark::DoNotOptimize(body::simulate(arm, input, {.q = {1.0}}, options));
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
  const body::SimulationModel arm = arm_in(mode);
  const std::vector<std::string> names = {
      "BIC.max_isometric_force", "BIC.optimal_fiber_length", "BIC.concentric_curvature", "BIC.tendon_slack_length",
      "TRI.max_isometric_force", "TRI.optimal_fiber_length", "TRI.concentric_curvature", "TRI.tendon_slack_length"};
  const body::SimulationInput input = bursting();
  const body::SimulationOptions options{.end_s = 1.0, .output_rate_hz = 100.0};
  for (auto _ : state) {
    benchmark::DoNotOptimize(body::simulate_sensitivities(arm, input, {.q = {1.0}}, options, names));
  }
}
BENCHMARK(simulate_arm_sensitivities)->Arg(0)->Arg(1)->Arg(2)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
