#pragma once

#include <functional>
#include <string>
#include <vector>

#include "myoid/body/dynamics/external_loads.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/progress.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::body {

struct ActuatorProblem;
struct ActuatorSolution;
/// Sees the problem of a frame and its solution (actuator_sharing.h), for checks.
/// Called from any thread, frames in any order.
using InspectFrame = std::function<void(Eigen::Index frame, const ActuatorProblem&, const ActuatorSolution&)>;

struct StaticOptimizationOptions {
  double exponent = 2.0;
  /// Force-length, force-velocity and pennation count; else a muscle's strength is F_max.
  bool muscle_physiology = true;
  const body::ExternalLoads* loads = nullptr;  ///< Not owned.
  Progress progress;
  InspectFrame inspect{};
};

struct StaticOptimizationResult {
  TimeSeries control;              ///< Activation of each muscle, control of each actuator [-].
  TimeSeries force;                ///< [N] or [N m]
  Eigen::VectorXd kkt_residual;    ///< Per frame (actuator_sharing.h).
  std::vector<bool> is_feasible;   ///< Per frame: the actuators can make the accelerations.
  std::vector<bool> is_certified;  ///< Per frame: optimal, by its KKT residual.
  int frames_failed = 0;           ///< Not certified.
  std::vector<Remark> notes;
};

/// Computes OpenSim's static optimization, frame by frame: the controls of least sum |x|^p of all
/// muscles and actuators of the model that give the accelerations `motion.qddot` of every
/// independent coordinate, under gravity, external loads and passive forces; active muscle force
/// only. Dependent coordinates follow their constraints, and constraint forces do no work:
///
///   T' (M qddot + C - gravity - external - passive - sum_i x_i g_i) = 0,   qdot = T u,
///
/// g_i the generalized force of actuator i at x_i = 1. Channels are the muscles and actuators that apply force, in the
/// order of the model's force set. Parallel over frames, with equal results for every number of threads.
[[nodiscard]] StaticOptimizationResult static_optimization(const body::BodyModel& model,
                                                           const body::JointMotion& motion,
                                                           const StaticOptimizationOptions& options = {});

}  // namespace myoid::body
