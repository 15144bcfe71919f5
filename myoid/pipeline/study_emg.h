#pragma once

#include <vector>

#include "myoid/pipeline/study_result.h"
#include "myoid/pipeline/trial_input.h"

namespace myoid::pipeline {

/// Turns the EMG of all trials into activations, in `result`: raw EMG is cleaned, whitened by one
/// filter for the study and rectified; envelopes are normalised by the study's greatest effort
/// (of its MVC trials, if any) and thinned to 250 Hz; activations stay as they came. The trials of
/// `result` stand in the order of `inputs`.
void process_emg_of_trials(const Study& study,
                           const std::vector<TrialInput>& inputs,
                           StudyResult& result);

}  // namespace myoid::pipeline
