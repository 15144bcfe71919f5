// Identification of ten trials of ten seconds at 200 Hz.
#include <string>

#include <benchmark/benchmark.h>

#include "myoid/fit/methods/force.h"
#include "myoid/fit/methods/torque.h"

#include "tests/support/elbow_study.h"

namespace {

using namespace myoid;
using fit::StudyData;

const StudyData& arm_study() {
  static const StudyData data = test::elbow_study({.trials = 10,
                                                   .seconds = 10.0,
                                                   .rate_hz = 200.0,
                                                   .emg_cv = 0.14,
                                                   .torque_sd_nm = 0.3,
                                                   .truth_from_prior = true,
                                                   .with_priors = true,
                                                   .seed = 1})
                                    .data;
  return data;
}

/// The first muscle: l0, l_sh, V_sh, V_sh V_shl and V_ml unknown.
void identify_one_muscle(benchmark::State& state) {
  StudyData data = fit::force_study(arm_study(), 0);
  data.muscles[0].fixed.push_back("max_isometric_force");
  fit::EstimatorOptions options;
  options.delay_s = 0.05;
  options.predictions = false;
  for (auto _ : state) benchmark::DoNotOptimize(fit::identify_torque(data, options));
}
BENCHMARK(identify_one_muscle)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

/// Nine trials of 15 s, four muscles; range(0): tendons that stretch by 3.3 % at F_max, or rigid ones.
void identify_tendons(benchmark::State& state) {
  StudyData data =
      test::elbow_study(
          {.trials = 9, .seconds = 15.0, .rate_hz = 20.0, .torque_sd_nm = 0.5, .with_priors = true, .seed = 2})
          .data;
  for (fit::MuscleSetup& muscle : data.muscles) muscle.extras.tendon_strain = state.range(0) != 0 ? 0.033 : 0.0;
  for (auto _ : state) benchmark::DoNotOptimize(fit::identify_torque(data, {.predictions = false}));
}
BENCHMARK(identify_tendons)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

/// All four, with the delay: 25 unknowns.
void identify_arm(benchmark::State& state) {
  fit::EstimatorOptions options;
  options.choose_lag = true;  // as `run` does
  options.predictions = false;
  for (auto _ : state) benchmark::DoNotOptimize(fit::identify_torque(arm_study(), options));
}
BENCHMARK(identify_arm)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace
