#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace myoid::page {

/// The questions that a finished run did not pass.
struct UnpassedGates {
  std::vector<std::string> failed, warned;  ///< Their names.
};

/// Reads the gates of a folder's report.json; none without that file. Throws ReadError for a damaged one.
[[nodiscard]] UnpassedGates read_gates(const std::filesystem::path& folder);

}  // namespace myoid::page
