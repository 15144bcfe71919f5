#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/ground/core/progress.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/ground/core/remark.h"
#include "myoid/run/fit_input.h"
#include "myoid/study/study.h"

namespace myoid::program {

/// The choice of trials to predict by the fit of a finished run.
struct PredictionChoice {
  std::string study;                     ///< Study with the trials; empty: the study of the run.
  std::vector<std::string> trials;       ///< Names; empty: all trials that took no part in the fit.
  std::optional<double> start_s, end_s;  ///< Times in the trials of another study.
  Progress progress;
};

/// The data of the run's fit and of the trials to predict.
struct PredictionInput {
  study::Study study;                  ///< Study of the run.
  run::FitInput fit;                   ///< Data of the run's fit: its calibration trials.
  std::vector<fit::TrialData> trials;  ///< Trials to predict.
  std::vector<InputFile> files;
  std::vector<Remark> remarks;
};

/// Computes motion, torque and activation as the run in `folder` did. The trials of the run keep
/// their use. Trials that the study got later, and trials of another study, are held back. Throws
/// ReadError for a folder without a run and for recordings that differ from the run's. Throws
/// InvalidInput for unknown trials and for another study with other muscles.
[[nodiscard]] PredictionInput prediction_input(const std::filesystem::path& folder, const PredictionChoice& choice);

}  // namespace myoid::program
