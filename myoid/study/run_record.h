#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "myoid/ground/core/provenance.h"

namespace myoid::study {

/// The facts of run.json from which a finished run can be computed again.
struct RunRecord {
  std::filesystem::path folder;
  std::filesystem::path study;
  std::string command;  ///< Empty: unknown.
  std::optional<double> start_s, end_s;
  std::map<std::string, std::string> uses;  ///< The use of each trial, by its name.
  std::vector<InputFile> inputs;
  std::map<std::string, double> seconds;  ///< The time of each stage.
};

/// Reads run.json of a run's folder. Throws ReadError for another file or one that does not name its study.
[[nodiscard]] RunRecord read_run_record(const std::filesystem::path& folder);

/// Throws ReadError for a recording that differs from the run's: of files of one name, the one whose folders agree
/// most. Files of the name `but` may differ.
void refuse_changed(const std::vector<InputFile>& inputs, const RunRecord& run, const std::filesystem::path& but = {});

}  // namespace myoid::study
