#pragma once

#include <filesystem>
#include <vector>

#include "myoid/page/report.h"

namespace myoid::results {

/// Many finished runs side by side (`myoid report --group`).
struct GroupReportOptions {
  std::vector<std::filesystem::path> persons;  ///< Folders as `read_group_persons` takes them.
  /// The second sessions of the same persons in the same order; empty: one session.
  std::vector<std::filesystem::path> after;
  std::filesystem::path folder;  ///< Folder of the page, to which its links are relative.
};

/// Returns the page of the persons: their changes first, where there is a second session, then the persons beside each
/// other. Throws InvalidInput if the sessions are not as many as the persons, and ReadError for a folder without a run.
[[nodiscard]] page::Report group_report(const GroupReportOptions& options);

}  // namespace myoid::results
