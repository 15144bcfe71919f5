#pragma once

#include <vector>

#include "myoid/intake/trial_input.h"
#include "myoid/run/study_result.h"
#include "myoid/signals/emg_chain.h"

namespace myoid {

/// The activations of all trials of `result` if the uses of its trials were those of `study`: EMG
/// is whitened, and compared with the greatest effort, as trials show that are not held back for
/// validation. A prediction of a trial that is held back rests on nothing of that trial but its own
/// envelopes.
[[nodiscard]] StudyActivations activations_without_validation(const Study& study,
                                                              const std::vector<TrialInput>& inputs,
                                                              const StudyResult& result);

/// Turns the EMG of all trials into activations, in `result`: raw EMG is cleaned, whitened by one
/// filter for the study and rectified; envelopes are normalised by the study's greatest effort
/// and thinned to 250 Hz; activations stay as they came. Trials that are held back for validation
/// have no part in filter and greatest effort. The trials of `result` stand in the order of
/// `inputs`.
void process_emg_of_trials(const Study& study,
                           const std::vector<TrialInput>& inputs,
                           StudyResult& result);

/// How the activations of a study came about, for the headers of files; without steps where there
/// is no EMG. `method`: of its forces, with the delay that it found; null: before any delay.
[[nodiscard]] signals::EmgChain emg_chain(const StudyResult& result,
                                          const identification::IdentificationResult* method);

}  // namespace myoid
