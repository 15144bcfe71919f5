#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "myoid/ground/core/progress.h"
#include "myoid/run/study_inputs.h"
#include "myoid/run/study_result.h"
#include "myoid/study/study.h"

namespace myoid::run {

struct RunOptions {
  std::optional<double> start_s, end_s;  ///< Times in every trial [s]; empty: as the study states.
  std::uint64_t seed = 1;                ///< Seed of the comparison of solvers.
  Progress progress;
  /// Called at the end of each stage with its work, "reads the recordings", and its seconds; may be empty.
  std::function<void(std::string_view work, double seconds)> stage_ended = {};
  /// Called with the files of the study when all are read, before any computation; may be empty, may throw.
  std::function<void(const std::vector<InputFile>& files)> files_read = {};
  /// Computes forces by static optimization, which methods `paper` and `force` need.
  bool share_forces = true;
  bool inform_forces = true;  ///< Computes forces with the identified muscles, informed by the EMG.
  /// Folder that keeps inverse kinematics between runs; empty: none.
  std::optional<std::filesystem::path> store;
};

/// Runs all stages after reading, on inputs that need not come from files (`in_memory`). Otherwise as `run_study`.
[[nodiscard]] StudyResult analyse(StudyInputs inputs, const RunOptions& options = {});

/// Runs the stages up to the data of the fit, which a prediction by an earlier fit needs. `fit`,
/// `folds` and `next` stay empty. Throws as `run_study`.
[[nodiscard]] StudyResult study_data(const study::Study& study, const RunOptions& options = {});

/// Runs all stages in order: reading, activation, motion, forces, data, fit, validation, findings.
/// Trials run in parallel, with the same numbers for every number of threads. Throws ReadError or
/// InvalidInput for unusable input, before any computation because all files are read first, and
/// Interrupted when stopped. A trial whose computation fails is marked and left out.
[[nodiscard]] StudyResult run_study(const study::Study& study, const RunOptions& options = {});

}  // namespace myoid::run
