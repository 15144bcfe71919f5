#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "myoid/commands/call.h"
#include "myoid/core/remark.h"

namespace myoid::commands {

/// Checks the inputs of a study, or one recording, without computing a result.
struct CheckOptions {
  Call call;
  std::string input;  ///< study.toml, or a recording.
  std::string up;     ///< Of a recording's laboratory: x, -y, ...; empty: as the file says.
};

struct CheckResult {
  std::vector<Remark> findings;  ///< Worst first.
  bool of_study = false;
  std::size_t trials = 0, muscles = 0;  ///< Of the study.
  std::size_t errors = 0;               ///< Findings because of which `run` refuses the study.
};

/// A fault of an input is a finding. Throws ReadError for a study that cannot be read.
[[nodiscard]] CheckResult check(const CheckOptions& options);

}  // namespace myoid::commands
