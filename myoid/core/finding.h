#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/core/fault.h"

namespace myoid {

/// What looking at the inputs brings to light.
struct Finding {
  enum class Level { error, warning, note };
  Level level = Level::note;
  std::string where;                ///< Trial or file.
  std::string message;              ///< With the remedy.
  std::optional<Fault> fault = {};  ///< If it is about a channel at a time.
  std::string kind = {};            ///< What is alike in several trials has one; empty: alone.
};
[[nodiscard]] std::string_view name(Finding::Level level);

/// The finding that a fault is.
[[nodiscard]] Finding finding(std::string where, Fault fault);

/// What has one kind and level is said once, of the trial that has it first; the others are named.
[[nodiscard]] std::vector<Finding> grouped(const std::vector<Finding>& findings);

}  // namespace myoid
