#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/study/intake/study_activation.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// The findings about the recordings of a study after processing of its EMG.
struct RecordingFindings {
  std::vector<std::vector<Remark>> of_trials;  ///< Ungrouped, in the study's order.
  std::vector<Remark> levels;                  ///< About EMG channels, over all trials.
  std::vector<Remark> dynamometers;            ///< Grouped; `where` is the trial.
};

/// Checks the channels of every trial, the levels of the EMG over all trials, and the signs of the dynamometers
/// (`dynamometer_signs`). `inputs` belong to the study's trials. Trials are checked in parallel.
[[nodiscard]] RecordingFindings recording_findings(const Study& study,
                                                   const body::BodyModel& model,
                                                   const std::vector<TrialInput>& inputs,
                                                   const StudyActivation& activation);

/// Returns the warnings among the faults, one line each. Equal faults of several trials or channels share a
/// line, and after `most` lines a last one counts the others.
[[nodiscard]] std::vector<std::string> fault_summary(std::vector<Remark> faults, std::size_t most = 12);

/// Returns the EMG of these inputs.
[[nodiscard]] EmgOfTrials emg_of(const std::vector<TrialInput>& inputs);

}  // namespace myoid::study
