#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "myoid/program/commands/identify_options.h"
#include "myoid/program/commands/run.h"
#include "myoid/study/study.h"

namespace myoid::program {

struct IdentifyResult {
  study::Study study;  ///< The files and choices of the options (identify_study.h).
  RunResult run;       ///< Its run.

  /// Returns the result of the only method.
  [[nodiscard]] const fit::IdentificationResult& fit() const { return run.study.fit.methods.front(); }
};

/// Makes a study of the files and choices, and runs it. Throws InvalidInput for options that the method or the files
/// cannot meet.
[[nodiscard]] IdentifyResult identify(const IdentifyOptions& options);

/// Returns the names of the files that `write_identify` writes beside the folders of trials.
[[nodiscard]] std::vector<std::string_view> identify_files();

/// Writes as `write_run`, and the study as study.toml.
void write_identify(IdentifyResult& result, const std::filesystem::path& folder);

}  // namespace myoid::program
