#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/run/stage_store.h"
#include "myoid/run/study_inputs.h"

namespace myoid::run {

/// The motion of one trial.
struct TrialMotion {
  /// The study's model, or a model of the trial: with its held mass, its calibrated coordinates, or
  /// the arm that its markers measure. Never null.
  std::shared_ptr<const body::BodyModel> model = std::make_shared<const body::BodyModel>();
  std::optional<body::IkResult> ik;  ///< For a trial with markers.
  bool ik_reused = false;            ///< Read from an earlier run with the same input.
  bool ik_was_damaged = false;       ///< An earlier run kept it, and its bytes changed since.
  body::JointMotion joints;          ///< On the clock of the analysis; empty for an MVC trial without
                                     ///< motion, without columns where lengths are given and no angles.
  std::vector<Remark> remarks;       ///< On the markers and coordinates, and what no movement does.
  std::string failure;               ///< Reason why the motion is missing; empty: none.
};

/// Computes the motion of one trial from its markers or coordinates. Reads inverse kinematics of the same input from
/// `store` and keeps new results there, unless `store` is nullptr. Throws InvalidInput if the motion cannot be
/// computed, for example if a held mass has no point of action.
[[nodiscard]] TrialMotion trial_motion(const StudySource& source,
                                       const study::TrialSpec& spec,
                                       const study::TrialInput& input,
                                       StageStore* store);

/// Computes the motion of all trials, in parallel. A trial whose motion cannot be computed holds the failure.
[[nodiscard]] std::vector<TrialMotion> study_motion(const StudyInputs& inputs,
                                                    StageStore* store,
                                                    const Progress& progress);

}  // namespace myoid::run
