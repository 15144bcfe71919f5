#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/core/progress.h"
#include "myoid/core/provenance.h"
#include "myoid/run/fit_input.h"
#include "myoid/study/study.h"

namespace myoid {

/// The choice of trials to predict by the fit of a finished run.
struct PredictionChoice {
  std::string study;                     ///< With the trials; empty: the study of the run.
  std::vector<std::string> trials;       ///< Names; none: all that took no part in the fit.
  std::optional<double> start_s, end_s;  ///< Of the trials of another study.
  Progress progress;
};

/// The data of the run's fit and of the trials to predict.
struct PredictionInput {
  Study study;                                    ///< Of the run.
  FitInput fit;                                   ///< Of the run: its calibration trials.
  std::vector<identification::TrialData> trials;  ///< To predict.
  std::vector<InputFile> files;
  std::vector<std::string> warnings;
};

/// Computes motion, torque and activation as the run in `folder` did. The trials of the run keep
/// their use; trials that the study got later, and those of another study, are held back. Throws
/// ReadError for a folder without a run and for recordings that changed since, InvalidInput for
/// names of trials that are not there and for another study of other muscles.
[[nodiscard]] PredictionInput prediction_input(const std::filesystem::path& folder,
                                               const PredictionChoice& choice);

}  // namespace myoid
