#pragma once

#include <vector>

#include "myoid/fit/measurement/study_data.h"
#include "myoid/run/trial_result.h"
#include "myoid/study/study.h"

namespace myoid::run {

/// Checks the stages that trials give (given_check.h, joint_of_arms.h), with the muscles' starting values, and adds
/// warnings to the trials. Throws InvalidInput, with the trial's name, for a certain fault.
void check_given(const study::Study& study, const fit::StudyData& data, std::vector<TrialResult>& trials);

}  // namespace myoid::run
