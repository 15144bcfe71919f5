#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "myoid/core/progress.h"
#include "myoid/core/time_series.h"
#include "myoid/math/ode.h"
#include "myoid/simulation/arm_dynamics.h"
#include "myoid/simulation/excitation.h"

namespace myoid::simulation {

/// How the arm begins.
struct ArmStart {
  double time_s = 0.0;
  double angle_rad = 0.0;
  double velocity_radps = 0.0;
  /// Per muscle; empty: settled on its first excitation.
  std::vector<muscle::ActivationPoint<double>> activation;
  /// Per muscle; empty: in equilibrium with the tendon at this activation, angle and velocity.
  std::vector<muscle::MusculotendonState<double>> fiber;
};

/// What drives it.
struct ArmInput {
  std::vector<Signal> excitation;  ///< Per muscle, 0..1.
  Signal external_torque_nm = constant(0.0);
};

/// Asked every `interval_s` for excitations, which it writes over those of before; they hold until
/// it is asked again. For a virtual person that corrects itself.
struct Controller {
  double interval_s = 0.01;
  std::function<void(double time_s, double angle_rad, double velocity_radps, std::span<double> u)>
      excite;
};

struct SimulationOptions {
  double end_s = 1.0;
  double output_rate_hz = 1000.0;      ///< Samples of the result, from the start on, ...
  std::vector<double> output_times_s;  ///< ... or, if not empty, these times.
  bool energy = false;                 ///< Integrate the work of every element too.
  bool locate_kinks =
      true;  ///< End steps where the right-hand side has a kink (slack, v = 0, ...).
  math::OdeOptions ode;
  Controller controller;  ///< Used, instead of the excitations, if it has a function.
  Progress progress;
};

/// A simulated movement; one row per output time.
struct Simulation {
  math::OdeStatus status = math::OdeStatus::done;
  std::string message;  ///< One sentence.
  math::OdeStatistics statistics;
  double reached_s = 0.0;  ///< The results go so far.

  /// elbow_flexion [rad], elbow_flexion_speed [rad/s], elbow_flexion_acceleration [rad/s^2]
  TimeSeries motion;
  /// Per muscle.
  TimeSeries excitation, activation;
  TimeSeries musculotendon_length, musculotendon_velocity, moment_arm;  ///< [m] [m/s] [m]
  TimeSeries fiber_length, fiber_velocity, tendon_length;               ///< [m] [m/s] [m]
  TimeSeries fiber_force, tendon_force;                                 ///< [N]
  /// muscles, gravity, joint, external [N m]; their sum is inertia times acceleration.
  TimeSeries torque;
  /// With `energy`: work given since the start by each element, and energy stored [J]; see
  /// `energy_balance`.
  TimeSeries energy;
};

/// Integrates the arm's equations of motion from `start` to `options.end_s`. Muscles with rigid
/// tendons alone make a problem for an explicit method, all others for an implicit one. Same input,
/// same result. Throws InvalidInput if arm, inputs or options cannot be used, and Interrupted on
/// request; a numerical failure is said by `status`.
[[nodiscard]] Simulation simulate(const Arm<double>& arm,
                                  const ArmInput& input,
                                  const ArmStart& start,
                                  const SimulationOptions& options);

}  // namespace myoid::simulation
