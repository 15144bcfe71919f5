// Timings of the hot paths, one per frame, sample or fit. Figures and command: docs/data/timings.txt.
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/dynamics/inverse_dynamics.h"
#include "myoid/body/forces/force_sharing.h"
#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/fit/methods/paper.h"
#include "myoid/fit/methods/torque.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/lab/virtual_person/virtual_arm.h"
#include "myoid/muscle/hill_muscle.h"

#include "tests/support/elbow_study.h"

namespace {

using namespace myoid;

constexpr Eigen::Index kFrames = 1000;  // ten seconds at 100 Hz

/// Elbow flexion that swings between 20 and 120 degrees at 0.5 Hz [rad].
TimeSeries elbow_motion() {
  const Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(kFrames, 0.0, 9.99);
  const Eigen::VectorXd q_rad = 1.22 + 0.87 * (kPi * time_s.array()).sin();
  return {time_s, {{"elbow_flexion", Unit::radian}}, q_rad};
}

const body::BodyModel& arm() {
  static const body::BodyModel model = body::parse_osim(body::arm4_osim(), "arm4.osim");
  return model;
}

body::JointMotion arm_motion() { return body::joint_motion(arm(), elbow_motion()).motion; }

void force_law(benchmark::State& state) {
  const muscle::HillParameters<double> muscle = body::arm4_muscles()[0];
  double velocity_mps = -0.3;
  for (auto _ : state) {
    benchmark::DoNotOptimize(muscle::hill_force(0.4, 0.12, velocity_mps, muscle));
    velocity_mps = -velocity_mps;  // both branches
  }
}
BENCHMARK(force_law);

void force_law_with_derivatives(benchmark::State& state) {
  const fit::MuscleValues muscle = fit::muscle_values(body::arm4_muscles()[0]);
  fit::Tension tension;
  double velocity_mps = -0.3;
  for (auto _ : state) {
    fit::plain_tension(0.4, 0.4, velocity_mps, muscle, tension);
    benchmark::DoNotOptimize(tension);
    velocity_mps = -velocity_mps;
  }
}
BENCHMARK(force_law_with_derivatives);

void read_model(benchmark::State& state) {
  const std::string text = body::arm4_osim();
  for (auto _ : state) benchmark::DoNotOptimize(body::parse_osim(text, "arm4.osim"));
}
BENCHMARK(read_model)->Unit(benchmark::kMicrosecond);

/// Items per second are frames per second, here and below.
void inverse_kinematics(benchmark::State& state) {
  const lab::VirtualArm virtual_arm{lab::VirtualSubject{}};
  const body::BodyModel model = body::parse_osim(virtual_arm.osim, "arm.osim");
  const TimeSeries motion = elbow_motion();
  const MarkerSeries markers{
      .time_s = motion.time_s(),
      .names = virtual_arm.marker_names(),
      .positions_m = virtual_arm.markers_m(motion.column("elbow_flexion"), lab::Plane::vertical)};
  for (auto _ : state) benchmark::DoNotOptimize(body::inverse_kinematics(model, markers));
  state.SetItemsProcessed(state.iterations() * kFrames);
}
BENCHMARK(inverse_kinematics)->Unit(benchmark::kMillisecond);

void smooth_motion(benchmark::State& state) {
  const TimeSeries q = elbow_motion();
  for (auto _ : state) benchmark::DoNotOptimize(body::joint_motion(arm(), q, {.cutoff_hz = 6.0}));
  state.SetItemsProcessed(state.iterations() * kFrames);
}
BENCHMARK(smooth_motion)->Unit(benchmark::kMillisecond);

void inverse_dynamics(benchmark::State& state) {
  const body::JointMotion motion = arm_motion();
  for (auto _ : state) benchmark::DoNotOptimize(body::inverse_dynamics(arm(), motion));
  state.SetItemsProcessed(state.iterations() * kFrames);
}
BENCHMARK(inverse_dynamics)->Unit(benchmark::kMillisecond);

void muscle_kinematics(benchmark::State& state) {
  const body::JointMotion motion = arm_motion();
  for (auto _ : state) benchmark::DoNotOptimize(body::muscle_kinematics(arm(), motion));
  state.SetItemsProcessed(state.iterations() * kFrames);
}
BENCHMARK(muscle_kinematics)->Unit(benchmark::kMillisecond);

/// One frame: range(0) muscles about three coordinates.
void share_one_frame(benchmark::State& state) {
  const auto muscles = static_cast<Eigen::Index>(state.range(0));
  body::SharingProblem problem;
  problem.moment_arm.resize(3, muscles);
  problem.optimal_force.resize(muscles);
  for (Eigen::Index i = 0; i < muscles; ++i) {
    const double x = static_cast<double>(i + 1);
    problem.moment_arm.col(i) << 0.04 * std::sin(2.1 * x), 0.03 * std::cos(3.7 * x), 0.02 * std::sin(5.3 * x);
    problem.optimal_force[i] = 500.0 + 300.0 * std::sin(x);
  }
  problem.torque = Eigen::Vector3d(8.0, -3.0, 2.0);
  problem.lower = Eigen::VectorXd::Zero(muscles);
  problem.upper = Eigen::VectorXd::Ones(muscles);
  problem.reserve = Eigen::VectorXd::Ones(3);
  for (auto _ : state) benchmark::DoNotOptimize(body::solve_sharing(problem));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(share_one_frame)->Arg(4)->Arg(40)->Arg(400)->Unit(benchmark::kMicrosecond);

test::ElbowStudy noisy_study(int trials) {
  return test::elbow_study({.trials = trials,
                            .seconds = 20.0,
                            .emg_cv = 0.14,
                            .torque_sd_nm = 0.3,
                            .truth_from_prior = true,
                            .with_priors = true,
                            .seed = 1});
}

/// Four muscles, range(0) trials of twenty seconds, noise as measured; priors, delay, three starts.
void identify_torque(benchmark::State& state) {
  const test::ElbowStudy study = noisy_study(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(fit::identify_torque(study.data));
}
BENCHMARK(identify_torque)->Arg(3)->Arg(12)->Unit(benchmark::kMillisecond);

void identify_paper(benchmark::State& state) {
  const test::ElbowStudy study = noisy_study(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(fit::identify_paper(study.data));
}
BENCHMARK(identify_paper)->Arg(3)->Unit(benchmark::kMillisecond);

}  // namespace
