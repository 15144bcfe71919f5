#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "myoid/core/progress.h"
#include "myoid/core/time_series.h"
#include "myoid/math/ode.h"
#include "myoid/muscle/activation.h"
#include "myoid/muscle/musculotendon.h"
#include "myoid/simulation/excitation.h"

namespace myoid::simulation {

/// How a skeleton with its muscles begins.
struct SimulationStart {
  double time_s = 0.0;
  std::vector<double> q;     ///< Per coordinate [rad | m].
  std::vector<double> qdot;  ///< Empty: at rest.
  /// Per muscle; empty: settled on its first excitation.
  std::vector<muscle::ActivationPoint<double>> activation;
  /// Per muscle; empty: in equilibrium with the tendon at this activation, posture and motion.
  std::vector<muscle::MusculotendonState<double>> fiber;
};

/// A coordinate moved by a device: its acceleration as a function of time, finite, and the times at
/// which that jumps. A function that is empty leaves the coordinate free.
struct Device {
  std::function<double(double time_s)> acceleration;
  std::vector<double> jumps_s;
};

/// Holds the coordinate at its start.
[[nodiscard]] Device locked();
/// At rest until `start_s`, then at the speed that is reached `rise_s` later, evenly accelerated,
/// and from `end_s` on slowed down in the same way.
[[nodiscard]] Device isokinetic(double start_s, double end_s, double speed, double rise_s = 0.05);

/// What drives it.
struct SimulationInput {
  std::vector<Signal> excitation;  ///< Per muscle, 0..1.
  std::vector<Signal> external;    ///< Per coordinate [N m | N]; empty: none.
  std::vector<Device> device;      ///< Per coordinate; empty: all are free.
};

/// Asked every `interval_s` for excitations, which it writes over those of before; they hold until
/// it is asked again. For a virtual person that corrects itself.
struct Controller {
  double interval_s = 0.01;
  std::function<void(double time_s,
                     std::span<const double> q,
                     std::span<const double> qdot,
                     std::span<double> excitation)>
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

/// A simulated movement; one row per output time. With one coordinate, columns that are per
/// coordinate bear no coordinate's name.
struct Simulation {
  math::OdeStatus status = math::OdeStatus::done;
  std::string message;  ///< One sentence.
  math::OdeStatistics statistics;
  double reached_s = 0.0;  ///< The results go so far.
  /// How often no step was short enough for the tolerance, because the right-hand side jumps (a
  /// path whose length does), and a nanosecond was passed without control of the error. 200 at
  /// most.
  long jumps_passed = 0;

  /// Per coordinate: NAME, NAME_speed, NAME_acceleration [rad | m ...].
  TimeSeries motion;
  /// Per muscle.
  TimeSeries excitation, activation;
  TimeSeries musculotendon_length, musculotendon_velocity;  ///< [m] [m/s]
  TimeSeries fiber_length, fiber_velocity, tendon_length;   ///< [m] [m/s] [m]
  TimeSeries fiber_force, tendon_force;                     ///< [N]
  /// Per muscle, or per coordinate and muscle "COORDINATE/MUSCLE" [m].
  TimeSeries moment_arm;
  /// muscles, gravity, joint, external, device; or "COORDINATE/muscles", ... [N m | N].
  TimeSeries torque;
  /// With `energy`: for every muscle the work given since the start by its elements,
  /// MUSCLE_active_work, ..._passive_, ..._viscous_, ..._tendon_, ..._kinetic_, and by the whole of
  /// it, ..._musculotendon_work; gravity_work, joint_elastic_work, joint_viscous_work,
  /// external_work (with devices); and the energies stored, MUSCLE_passive_energy, ..._tendon_,
  /// ..._kinetic_, skeleton_kinetic_energy, gravity_energy, joint_elastic_energy. In joules, which
  /// are [N m].
  TimeSeries energy;
};

/// How far the books are from closing: of every element, |work + change of stored energy|, and of
/// muscles and skeleton, |sum of the works in - work out - change|, over the sum of the absolute
/// works of the muscles' contractile and viscous parts; the largest of all, at the last row. Throws
/// InvalidInput if the simulation was done without `energy`.
struct EnergyBalance {
  double worst = 0.0;
  std::string where;           ///< Which element that is.
  double turned_over_j = 0.0;  ///< What it is relative to.
};
[[nodiscard]] EnergyBalance energy_balance(const Simulation& simulation);

}  // namespace myoid::simulation
