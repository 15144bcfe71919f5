#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/pipeline/study.h"

namespace myoid::pipeline {

/// What reading all inputs brings to light.
struct Finding {
  enum class Level { error, warning, note };
  Level level = Level::note;
  std::string where;    ///< Trial or file.
  std::string message;  ///< With the remedy.
};
[[nodiscard]] std::string_view name(Finding::Level level);

/// Reads every input of the study, checks units, rates, names, gaps, overlap of EMG and motion,
/// and the level that EMG is measured against; worst first. A study without an error here is not
/// refused by `run_study`. Does not throw for what is wrong with an input: that is a finding.
[[nodiscard]] std::vector<Finding> check_study(const Study& study);

}  // namespace myoid::pipeline
