#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "myoid/core/remark.h"
#include "myoid/intake/study_activation.h"
#include "myoid/intake/trial_input.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// The findings about the recordings of a study, once its EMG is processed.
struct RecordingFindings {
  std::vector<std::vector<Remark>> of_trials;  ///< As they came, in the study's order.
  std::vector<Remark> levels;                  ///< Of EMG channels, over all trials.
  std::vector<Remark> dynamometers;            ///< Grouped; `where` is the trial.
};

/// Looks at the channels of every trial, at the levels of the EMG over all trials, and at the signs
/// of the dynamometers (`dynamometer_signs`). `inputs` are those of the study's trials. Trials in
/// parallel.
[[nodiscard]] RecordingFindings recording_findings(const Study& study,
                                                   const model::BodyModel& model,
                                                   const std::vector<TrialInput>& inputs,
                                                   const StudyActivation& activation);

/// The warnings among the faults, a line each: alike faults of several trials are one line, and
/// after `most` lines a last one counts the others.
[[nodiscard]] std::vector<std::string> fault_summary(std::vector<Remark> faults,
                                                     std::size_t most = 12);

/// The EMG of these inputs.
[[nodiscard]] EmgOfTrials emg_of(const std::vector<TrialInput>& inputs);

}  // namespace myoid
