#pragma once

#include <map>
#include <string>
#include <vector>

#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/kinematics/path_surrogate.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/progress.h"

namespace myoid::body {

/// Muscles over time; channels are the muscles, in the model's order.
struct MuscleKinematics {
  TimeSeries length;    ///< Musculotendon length [m].
  TimeSeries velocity;  ///< dl/dt [m/s], lengthening positive.
  /// r = -dl/dq [m] by the name of every coordinate that is not locked. Coordinates that
  /// constraints couple move along, as in OpenSim (coupling_matrix in body/model/constraints.h). If
  /// takes_rates_for_speeds (angular_speeds.h) the arms belong to the speeds.
  std::map<std::string, TimeSeries> moment_arm;
  long from_surrogates = 0;  ///< Number of paths (frames x muscles) computed by polynomials.
};

struct MuscleKinematicsOptions {
  /// Polynomials instead of paths, one per muscle in the model's order; not owned. The path itself
  /// is computed for a polynomial beyond its tolerance and for a frame beyond its range.
  const std::vector<PathSurrogate>* surrogates = nullptr;
  Progress progress;
};

/// Computes lengths, velocities and moment arms of all muscles along a motion. Parallel over frames, with equal results
/// for every number of threads. Throws Interrupted if a stop is requested.
[[nodiscard]] MuscleKinematics muscle_kinematics(const body::BodyModel& model,
                                                 const JointMotion& motion,
                                                 const MuscleKinematicsOptions& options = {});

}  // namespace myoid::body
