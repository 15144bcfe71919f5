#pragma once

#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

/// Returns a fit's entry for a trial that holds only the trial's own facts: name, joint, time and measured torque.
[[nodiscard]] TrialFit unfitted_trial(const TrialData& trial);

/// Fills both torques of `fit` from its muscle forces: sum over muscles of r F plus the joint's
/// resting torque. Nothing is filled where the trial has no moment arms.
void add_torques_of_forces(const TrialData& trial, TrialFit& fit);

}  // namespace myoid::identification
