#pragma once

#include <string>
#include <utility>
#include <vector>

#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/progress.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::body {

struct MuscleAnalysisOptions {
  std::vector<int> muscles{};      ///< Indices in the model; empty: all.
  std::vector<int> coordinates{};  ///< Coordinates of the moment arms and moments.
  /// Fiber and tendon in balance in every frame; else fibers have `fiber_length_m`.
  bool equilibrium = true;
  /// Frames x all muscles of the model; empty: the model's default values.
  Eigen::MatrixXd activation{}, fiber_length_m{};
  Progress progress{};
};

struct MuscleAnalysis {
  /// Table by OpenSim's name: "MomentArm_<coordinate>", "Moment_<coordinate>", "PennationAngle", "Length",
  /// "FiberLength", ... in the order in which its analysis writes them; channels are the muscles.
  std::vector<std::pair<std::string, TimeSeries>> tables;
  std::vector<Remark> notes;
};

/// Computes the tables of OpenSim's MuscleAnalysis along a motion [m, m/s, rad, rad/s, N, N m, W; fractions of the
/// optimal length and of v_max]. Positive powers do work on the outside: fiber -F v, tendon -F v, muscle -F dl/dt.
/// Moment arms are those of body::MuscleKinematics; a moment is arm times tendon force. Dependent coordinates
/// first meet their constraints. Parallel over frames, with equal results for every number of threads.
[[nodiscard]] MuscleAnalysis muscle_analysis(const body::BodyModel& model,
                                             const body::JointMotion& motion,
                                             const MuscleAnalysisOptions& options = {});

}  // namespace myoid::body
