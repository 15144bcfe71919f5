#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/core/remark.h"
#include "myoid/core/time_series.h"
#include "myoid/dynamics/ground_support.h"
#include "myoid/forces/force_sharing.h"
#include "myoid/intake/study_activation.h"
#include "myoid/kinematics/muscle_kinematics.h"
#include "myoid/methods/resting_torque.h"
#include "myoid/run/study_inputs.h"
#include "myoid/run/trial_motion.h"

namespace myoid {

/// The torques, muscle paths and shared forces of one trial; all empty without motion.
struct TrialForces {
  TimeSeries generalized;                ///< Inverse dynamics, all coordinates; empty where forces alone are given.
  kinematics::MuscleKinematics muscles;  ///< Paths of the model's muscles.
  TimeSeries muscle_torque;              ///< Torque of the muscles, for the study's coordinates [N m].
  forces::MuscleForces shared;           ///< Forces of the model's muscles.
  /// Times in which torques lack a ground reaction.
  std::optional<dynamics::UncarriedTime> uncarried;
  std::vector<Remark> remarks;
  std::string failure;  ///< Reason why the forces could not be computed; empty otherwise.
};

/// The forces of all trials, in the study's order.
struct StudyForces {
  std::vector<TrialForces> trials;
  std::vector<identification::RestingJoint> resting;  ///< Joints whose passive torque was measured.
};

/// Computes inverse dynamics and muscle paths of one trial, without sharing. Columns that the trial gives are taken
/// from there; given torques replace inverse dynamics. Throws InvalidInput.
[[nodiscard]] TrialForces trial_torques(const StudySource& source,
                                        const TrialSpec& spec,
                                        const TrialInput& input,
                                        const TrialMotion& motion);

/// Shares the torques of the study's joints among the model's muscles, as `myoid so` does (forces::sharing_input): with
/// the curves of each muscle's own class and the model's passive forces. The torque of a dynamometer and the joints'
/// resting torques (`resting`) are not shared. Given forces are returned as they are. Notes on the sharing go to
/// `remarks`.
[[nodiscard]] forces::MuscleForces shared_forces(const Study& study,
                                                 const TrialInput& input,
                                                 const TrialMotion& motion,
                                                 const TrialForces& torques,
                                                 const std::vector<identification::RestingJoint>& resting,
                                                 std::vector<Remark>& remarks);

/// Computes the torques of all trials, then the resting joints from the passive ones, then, if
/// `share`, shared forces; trials in parallel. A trial that cannot be computed holds the failure.
[[nodiscard]] StudyForces study_forces(const StudyInputs& inputs,
                                       const StudyActivation& activation,
                                       const std::vector<TrialMotion>& motion,
                                       bool share,
                                       const Progress& progress);

}  // namespace myoid
