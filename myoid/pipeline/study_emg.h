#pragma once

#include <vector>

#include "myoid/pipeline/study_result.h"
#include "myoid/pipeline/trial_input.h"
#include "myoid/signals/emg_chain.h"

namespace myoid::pipeline {

/// Turns the EMG of all trials into activations, in `result`: raw EMG is cleaned, whitened by one
/// filter for the study and rectified; envelopes are normalised by the study's greatest effort
/// (of its MVC trials, if any) and thinned to 250 Hz; activations stay as they came. The trials of
/// `result` stand in the order of `inputs`.
void process_emg_of_trials(const Study& study,
                           const std::vector<TrialInput>& inputs,
                           StudyResult& result);

/// How the activations of a study came about, for the headers of files; without steps where there
/// is no EMG. `method`: of its forces, with the delay that it found; null: before any delay.
[[nodiscard]] signals::EmgChain emg_chain(const StudyResult& result,
                                          const identification::IdentificationResult* method);

}  // namespace myoid::pipeline
