#pragma once

#include <vector>

#include "myoid/core/fault.h"
#include "myoid/core/finding.h"
#include "myoid/intake/study_activation.h"
#include "myoid/intake/trial_input.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// The findings about the recordings of a study, once its EMG is processed.
struct RecordingFindings {
  std::vector<std::vector<Fault>> of_trials;  ///< As they came, in the study's order.
  std::vector<Fault> levels;                  ///< Of EMG channels, over all trials.
  std::vector<Finding> dynamometers;          ///< Grouped; `where` is the trial.
};

/// Looks at the channels of every trial, at the levels of the EMG over all trials, and at the signs
/// of the dynamometers (`dynamometer_signs`). `inputs` are those of the study's trials. Trials in
/// parallel.
[[nodiscard]] RecordingFindings recording_findings(const Study& study,
                                                   const model::BodyModel& model,
                                                   const std::vector<TrialInput>& inputs,
                                                   const StudyActivation& activation);

/// The EMG of these inputs.
[[nodiscard]] EmgOfTrials emg_of(const std::vector<TrialInput>& inputs);

}  // namespace myoid
