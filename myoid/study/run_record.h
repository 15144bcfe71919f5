#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "myoid/core/provenance.h"
#include "myoid/identification/options.h"

namespace myoid {

/// The facts of run.json by which a finished run is computed again.
struct RunRecord {
  std::filesystem::path folder;
  std::filesystem::path study;
  std::string command;  ///< Empty: not told.
  std::optional<double> start_s, end_s;
  std::optional<identification::EstimatorKind> estimator;  ///< Of the run.
  std::map<std::string, std::string> uses;                 ///< The use of each trial, by its name.
  std::vector<InputFile> inputs;
};

/// Reads run.json of a run's folder. Throws ReadError if it is none or does not name its study.
[[nodiscard]] RunRecord read_run_record(const std::filesystem::path& folder);

/// Throws ReadError for a recording that has changed since the run. `but` may differ: files of this
/// name.
void refuse_changed(const std::vector<InputFile>& inputs,
                    const RunRecord& run,
                    const std::filesystem::path& but = {});

}  // namespace myoid
