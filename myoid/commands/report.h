#pragma once

#include <filesystem>
#include <string>

#include "myoid/commands/call.h"
#include "myoid/core/provenance.h"
#include "myoid/run/study_result.h"

namespace myoid::commands {

/// The report of a finished run, made anew from its recordings.
struct ReportOptions {
  Call call;
  std::string folder;  ///< Of the run, with run.json.
};

struct ReportResult {
  StudyResult study;
  Provenance provenance;
};

/// Runs the study of the folder as it was run. Throws ReadError where run.json does not tell how,
/// or a recording has changed.
[[nodiscard]] ReportResult report(const ReportOptions& options);

/// Writes report.html, figures, tables and the page with the moving model.
void write_report(const ReportResult& result, const std::filesystem::path& folder);

}  // namespace myoid::commands
