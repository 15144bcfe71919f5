#pragma once

#include <string>
#include <vector>

#include "tests/damage/damages.h"
#include "tests/damage/kinds.h"

namespace myoid::damage {

/// A damaged file and its kind.
struct Variant {
  const Kind* kind = nullptr;
  Damaged file;
};

/// What `info`, `info --json`, `check`, `convert` and `emg` did with files.
struct CommandRuns {
  int runs = 0;
  double most_memory_mb = 0.0;        ///< Of one run.
  std::vector<std::string> failures;  ///< A line for each run that broke its promise.
};

/// Runs the commands on every variant, each as a process, several at a time. A command promises to
/// end by itself with exit code 0 or 3, within 2 GB of memory and 20 s, and to say why where it is
/// 3. Under the sanitizers, which need more memory and time, only every eighth variant is taken,
/// and memory is not limited.
[[nodiscard]] CommandRuns run_commands(const std::vector<Variant>& variants);

}  // namespace myoid::damage
