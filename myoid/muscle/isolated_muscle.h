#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "myoid/ground/core/progress.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/ground/math/ode.h"
#include "myoid/muscle/excitation_response.h"
#include "myoid/muscle/musculotendon.h"

namespace myoid::muscle {

/// A muscle in a testing machine: the whole length is imposed, the drive given.
struct IsolatedMuscleInput {
  /// Samples of the length of fiber and tendon together [s], [m]; at least two, any spacing.
  /// Between them a cubic that keeps their shape (no overshoot, continuous velocity).
  Eigen::VectorXd time_s, length_m;

  /// Samples of the drive, in 0..1; straight between them, constant outside. A drive of nothing but 0 and 1 is a
  /// switch, turned at the first sample of a new value. Times may be empty if there is one value: constant.
  Eigen::VectorXd drive_time_s, drive;
  /// True: the drive is an excitation, and the active state follows by `response`. False: the drive is the active
  /// state.
  bool drive_is_excitation = false;
  ExcitationResponse response;
  /// State of the activation's law at the first time, with an excitation; empty: settled on the first drive.
  std::optional<double> initial_activation;
};

struct IsolatedMuscleOptions {
  Eigen::VectorXd output_time_s;  ///< Within the samples of the length; empty: their times.
  double relative_tolerance = 1e-9;
  double absolute_tolerance = 1e-12;  ///< [m], [m/s], [-]
  long max_steps = 5'000'000;
  Progress progress;
};

/// The simulated experiment. On failure the series ends where the integration did.
struct IsolatedMuscleResult {
  math::OdeStatus status = math::OdeStatus::done;
  std::string message;  ///< One sentence.
  math::OdeStatistics statistics;
  /// activation, musculotendon_length [m], musculotendon_velocity [m/s], fiber_length [m],
  /// fiber_velocity [m/s], pennation [rad], tendon_length [m], active_fiber_force,
  /// passive_fiber_force (elastic and viscous), fiber_force, tendon_force [N].
  TimeSeries series;
};

/// Integrates the muscle from equilibrium at the first sample (length, velocity and activation
/// there) along the imposed length, ending a step at every sample of length and drive. Throws
/// InvalidInput if sizes differ, times do not strictly increase, a value is not finite, a drive
/// lies outside 0..1 or an output time outside the samples; Interrupted on request.
[[nodiscard]] IsolatedMuscleResult simulate_isolated_muscle(const Musculotendon<double>& unit,
                                                            const IsolatedMuscleInput& input,
                                                            const IsolatedMuscleOptions& options = {});

/// Returns the tendon's force [N] of the same experiment alone; NaN at times that the integration did not reach.
[[nodiscard]] Eigen::VectorXd isolated_tendon_force(const Musculotendon<double>& unit,
                                                    const IsolatedMuscleInput& input,
                                                    const IsolatedMuscleOptions& options = {});

/// Returns the input with as few samples of the length as hold its curve within `tolerance_m` of every sample: the
/// integration, which ends a step at each sample, goes in long steps where the length is smooth.
[[nodiscard]] IsolatedMuscleInput thinned(const IsolatedMuscleInput& input, double tolerance_m);

}  // namespace myoid::muscle
