#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "myoid/kinematics/inverse_kinematics.h"
#include "myoid/kinematics/joint_motion.h"
#include "myoid/model/body_model.h"
#include "myoid/run/stage_store.h"
#include "myoid/run/study_inputs.h"

namespace myoid {

/// The motion of one trial.
struct TrialMotion {
  /// The study's model, or one of the trial's own: with its held mass, its calibrated coordinates,
  /// or the arm that its markers measure. Never null.
  std::shared_ptr<const model::BodyModel> model = std::make_shared<const model::BodyModel>();
  std::optional<kinematics::IkResult> ik;  ///< Of a trial with markers.
  bool ik_reused = false;                  ///< Taken from an earlier run with the same input.
  kinematics::JointMotion joints;  ///< On the clock of the analysis; empty for an MVC trial without
                                   ///< motion.
  std::vector<std::string> notes;
  std::string failure;  ///< Reason why there is no motion; empty: none.
};

/// Computes the motion of one trial from its markers or coordinates. Inverse kinematics of the same
/// input is taken from `store` and kept there, unless it is nullptr. Throws InvalidInput where the
/// motion cannot be computed, as when a held mass has no place to act.
[[nodiscard]] TrialMotion trial_motion(const StudySource& source,
                                       const TrialSpec& spec,
                                       const TrialInput& input,
                                       StageStore* store);

/// Computes the motion of all trials, in parallel. A trial whose motion cannot be computed holds
/// the failure.
[[nodiscard]] std::vector<TrialMotion> study_motion(const StudyInputs& inputs,
                                                    StageStore* store,
                                                    const Progress& progress);

}  // namespace myoid
