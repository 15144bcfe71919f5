#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/program/steps/call.h"
#include "myoid/results/comparison/compare_runs.h"
#include "myoid/study/setting.h"

namespace myoid::program {

/// Two finished runs, to be compared number by number.
struct CompareOptions {
  Call call;
  std::string first, second;  ///< Folders with parameters.json.
  std::string out;            ///< Folder of `write_compare`; empty: not written.
};
void visit(CompareOptions& options, study::SettingVisitor& v);

struct CompareResult {
  results::RunComparison comparison;
  std::vector<Remark> remarks;
};

/// Compares the runs. Throws InvalidInput if both names are one folder.
[[nodiscard]] CompareResult compare(const CompareOptions& options);

/// Writes report.html, figures and tables.
void write_compare(const CompareResult& result, const std::filesystem::path& folder);

}  // namespace myoid::program
