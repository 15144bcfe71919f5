#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/program/steps/call.h"
#include "myoid/study/setting.h"

namespace myoid::program {

/// Checks the inputs of a study, one recording or motion, or a model, without computing a result.
struct CheckOptions {
  Call call;
  std::string input;  ///< study.toml, a recording, or a model (.osim).
  std::string model;  ///< Model of a motion (.mot, .sto), .osim or "arm4"; empty: unknown.
  std::string up;     ///< Vertical of a recording's laboratory: x, -y, ...; empty: as the file states.
};
void visit(CheckOptions& options, study::SettingVisitor& v);

struct CheckResult {
  std::vector<Remark> findings;  ///< Worst first.
  bool of_study = false;
  std::size_t trials = 0, muscles = 0;  ///< Counts in the study.
  std::size_t errors = 0;               ///< Findings for which `run` refuses the study.
};

/// Checks the inputs; a fault of an input is a finding. Throws ReadError for an unreadable study.
[[nodiscard]] CheckResult check(const CheckOptions& options);

/// The folder into which `run` can write the results of a study.
struct ResultsPlace {
  std::filesystem::path folder;
  bool overwrite = false;  ///< It holds an earlier run of the same study.
};
/// Returns `results` beside the study or, where another one's files stand there, `results-2`, `results-3`, ...
[[nodiscard]] ResultsPlace place_for_results(const std::filesystem::path& study);

}  // namespace myoid::program
