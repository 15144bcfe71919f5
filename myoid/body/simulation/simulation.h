#pragma once

#include <functional>
#include <string>
#include <vector>

#include "myoid/body/simulation/excitation.h"
#include "myoid/ground/core/progress.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/ground/math/ode.h"
#include "myoid/muscle/activation.h"
#include "myoid/muscle/musculotendon.h"

namespace myoid::body {

/// Initial state of a skeleton with its muscles.
struct SimulationStart {
  double time_s = 0.0;
  std::vector<double> q;     ///< One per coordinate [rad | m].
  std::vector<double> qdot;  ///< Empty: at rest.
  /// One per muscle; empty: the steady state of its first excitation.
  std::vector<muscle::ActivationPoint<double>> activation;
  /// One per muscle; empty: in equilibrium with the tendon at this activation, posture and motion.
  std::vector<muscle::MusculotendonState<double>> fiber;
};

/// A device that moves a coordinate: its acceleration as a function of time, finite, and the times
/// of its jumps. An empty function leaves the coordinate free.
struct Device {
  std::function<double(double time_s)> acceleration;
  std::vector<double> jumps_s;
};

/// Holds the coordinate at its initial value.
[[nodiscard]] Device locked();

/// Excitations, external forces and devices.
struct SimulationInput {
  std::vector<Signal> excitation;  ///< One per muscle, 0..1.
  std::vector<Signal> external;    ///< One per coordinate [N m | N]; may be empty.
  std::vector<Device> device;      ///< One per coordinate; empty: all are free.
};

struct SimulationOptions {
  double end_s = 1.0;
  double output_rate_hz = 1000.0;      ///< Rate of the result's samples, from the start on.
  std::vector<double> output_times_s;  ///< Times of the result's samples; overrides the rate unless empty.
  bool energy = false;                 ///< Also integrate the work of every element.
  math::OdeOptions ode;
  Progress progress;
};

/// A simulated movement, one row per output time. With one coordinate, columns per coordinate have
/// no coordinate in their names.
struct Simulation {
  math::OdeStatus status = math::OdeStatus::done;
  std::string message;  ///< One sentence.
  math::OdeStatistics statistics;
  double reached_s = 0.0;  ///< Last time of the results.
  /// Number of jumps of the right-hand side (a path whose length jumps) at which no step was short
  /// enough for the tolerance, so that a nanosecond was passed without error control. 200 at most.
  long jumps_passed = 0;

  /// For each coordinate: NAME, NAME_speed, NAME_acceleration [rad | m ...].
  TimeSeries motion;
  /// One column per muscle.
  TimeSeries excitation, activation;
  TimeSeries musculotendon_length, musculotendon_velocity;  ///< [m] [m/s]
  TimeSeries fiber_length, fiber_velocity, tendon_length;   ///< [m] [m/s] [m]
  TimeSeries fiber_force, tendon_force;                     ///< [N]
  /// One column per muscle, or per coordinate and muscle "COORDINATE/MUSCLE" [m].
  TimeSeries moment_arm;
  /// muscles, gravity, joint, external, device; or "COORDINATE/muscles", ... [N m | N].
  TimeSeries torque;
  /// With `energy`: for every muscle the work of its elements since the start, MUSCLE_active_work,
  /// ..._passive_, ..._viscous_, ..._tendon_, ..._kinetic_, and of the whole muscle,
  /// ..._musculotendon_work; gravity_work, joint_elastic_work, joint_viscous_work, external_work
  /// (with devices); and the stored energies, MUSCLE_passive_energy, ..._tendon_, ..._kinetic_,
  /// skeleton_kinetic_energy, gravity_energy, joint_elastic_energy. In joules, which are [N m].
  TimeSeries energy;
};

/// Error of the energy balance at the last row: for every element |work + change of stored energy|, and for muscles and
/// skeleton |sum of the works in - work out - change|, relative to the sum of the absolute works of the muscles'
/// contractile and viscous parts. The largest of all. Throws InvalidInput if the simulation has no `energy`.
struct EnergyBalance {
  double worst = 0.0;
  std::string where;           ///< Name of the element with this error.
  double turned_over_j = 0.0;  ///< The absolute works that scale the error.
};
[[nodiscard]] EnergyBalance energy_balance(const Simulation& simulation);

}  // namespace myoid::body
