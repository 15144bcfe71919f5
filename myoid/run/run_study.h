#pragma once

#include <filesystem>
#include <optional>

#include "myoid/core/progress.h"
#include "myoid/run/study_inputs.h"
#include "myoid/run/study_result.h"
#include "myoid/study/study.h"

namespace myoid {

struct RunOptions {
  std::optional<double> start_s, end_s;  ///< Of every trial [s]; empty: as the study says.
  Progress progress;
  /// Compute forces by static optimization, which methods `paper` and `force` need.
  bool share_forces = true;
  bool inform_forces = true;  ///< Forces with the identified muscles, informed by the EMG.
  /// Folder that keeps inverse kinematics between runs; empty: none.
  std::optional<std::filesystem::path> store;
};

/// Runs all stages after reading, on inputs that need not come from files (`in_memory`). Otherwise
/// as `run_study`.
[[nodiscard]] StudyResult analyse(StudyInputs inputs, const RunOptions& options = {});

/// Runs the stages up to the data of the fit: everything that a prediction by an earlier fit needs.
/// `fit`, `folds` and `next` stay empty. Throws as `run_study`.
[[nodiscard]] StudyResult study_data(const Study& study, const RunOptions& options = {});

/// Runs all stages in order: reading, activation, motion, forces, data, fit, validation, findings;
/// trials in parallel, the same numbers for every number of threads. Throws ReadError or
/// InvalidInput for input that cannot be used (nothing is computed then: all files are read first),
/// Interrupted when stopped. A trial whose computation fails is marked and left out.
[[nodiscard]] StudyResult run_study(const Study& study, const RunOptions& options = {});

}  // namespace myoid
