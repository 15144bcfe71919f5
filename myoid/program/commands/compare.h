#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/program/commands/call.h"
#include "myoid/results/compare_runs.h"

namespace myoid::program {

/// Two finished runs, to be compared number by number.
struct CompareOptions {
  Call call;
  std::string first, second;  ///< Folders with parameters.json.
};

struct CompareResult {
  results::RunComparison comparison;
  std::vector<Remark> remarks;
};

/// Compares the runs. Throws InvalidInput if both names are one folder.
[[nodiscard]] CompareResult compare(const CompareOptions& options);

/// Writes report.html, figures and tables.
void write_compare(const CompareResult& result, const std::filesystem::path& folder);

}  // namespace myoid::program
