#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/core/geometry.h"
#include "myoid/pipeline/study.h"
#include "myoid/signals/fault.h"

namespace myoid::pipeline {

/// What reading all inputs brings to light.
struct Finding {
  enum class Level { error, warning, note };
  Level level = Level::note;
  std::string where;                    ///< Trial or file.
  std::string message;                  ///< With the remedy.
  std::optional<signals::Fault> fault;  ///< If it is about a channel at a time.
};
[[nodiscard]] std::string_view name(Finding::Level level);

/// The finding that a fault is.
[[nodiscard]] Finding finding(std::string where, signals::Fault fault);

/// What a single recording shows (`read_recording`): markers, EMG in volts, force plates under this
/// vertical. Throws ReadError.
[[nodiscard]] std::vector<Finding> check_recording(const std::filesystem::path& path,
                                                   const Vec3& up_G);

/// Reads every input of the study, looks at the quality of every channel, checks units, rates,
/// names, gaps, overlap of EMG and motion, and the level that EMG is measured against; worst first.
/// A study without an error here is not refused by `run_study`. Does not throw for what is wrong
/// with an input: that is a finding.
[[nodiscard]] std::vector<Finding> check_study(const Study& study);

}  // namespace myoid::pipeline
