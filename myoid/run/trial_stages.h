#pragma once

#include <string_view>

#include "myoid/intake/trial_input.h"
#include "myoid/run/stage_store.h"
#include "myoid/run/study_result.h"

namespace myoid {

/// From the markers or the coordinates of one trial to its motion, joint torques, muscle paths and,
/// if `share_forces`, forces by static optimization of what the joints do not make by themselves
/// (`resting`), all into `trial`, whose `spec` is set. Inverse
/// kinematics of the same input is taken from `store` and kept there, unless it is nullptr. A trial
/// without either (an MVC trial) keeps an empty motion. Throws InvalidInput where it cannot be
/// computed, as when a held mass has no place to act.
void compute_trial(const Study& study,
                   const TrialInput& input,
                   std::string_view model_text,
                   bool share_forces,
                   const std::vector<identification::RestingJoint>& resting,
                   StageStore* store,
                   TrialResult& trial);

}  // namespace myoid
