#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/body/dynamics/ground_support.h"
#include "myoid/body/forces/force_sharing.h"
#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/run/resting_torque.h"
#include "myoid/run/study_inputs.h"
#include "myoid/run/trial_motion.h"
#include "myoid/study/intake/study_activation.h"

namespace myoid::run {

/// The torques, muscle paths and shared forces of one trial; all empty without motion.
struct TrialForces {
  TimeSeries generalized;          ///< Inverse dynamics, all coordinates; empty where forces alone are given.
  body::MuscleKinematics muscles;  ///< Paths of the model's muscles.
  TimeSeries muscle_torque;        ///< Torque of the muscles, for the study's coordinates [N m].
  body::MuscleForces shared;       ///< Forces of the model's muscles.
  /// Times in which torques lack a ground reaction.
  std::optional<body::UncarriedTime> uncarried;
  std::vector<Remark> remarks;
  std::string failure;  ///< Reason why the forces could not be computed; empty otherwise.
};

/// The forces of all trials, in the study's order.
struct StudyForces {
  std::vector<TrialForces> trials;
  std::vector<RestingJoint> resting;  ///< Joints whose passive torque was measured.
};

/// Computes inverse dynamics and muscle paths of one trial, without sharing. Columns that the trial gives are taken
/// from there; given torques replace inverse dynamics. Throws InvalidInput.
[[nodiscard]] TrialForces trial_torques(const StudySource& source,
                                        const study::TrialSpec& spec,
                                        const study::TrialInput& input,
                                        const TrialMotion& motion);

/// Shares the torques of the study's joints among the model's muscles, as `myoid so` does (body::sharing_input): with
/// the curves of each muscle's own class and the model's passive forces. The torque of a dynamometer and the joints'
/// resting torques (`resting`) are not shared. Given forces are returned as they are. Notes on the sharing go to
/// `remarks`.
[[nodiscard]] body::MuscleForces shared_forces(const study::Study& study,
                                               const study::TrialInput& input,
                                               const TrialMotion& motion,
                                               const TrialForces& torques,
                                               const std::vector<RestingJoint>& resting,
                                               std::vector<Remark>& remarks);

/// Computes the torques of all trials, then the resting joints from the passive ones, then, if
/// `share`, shared forces; trials in parallel. A trial that cannot be computed holds the failure.
[[nodiscard]] StudyForces study_forces(const StudyInputs& inputs,
                                       const study::StudyActivation& activation,
                                       const std::vector<TrialMotion>& motion,
                                       bool share,
                                       const Progress& progress);

}  // namespace myoid::run
