#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/ground/core/provenance.h"
#include "myoid/program/commands/run.h"
#include "myoid/results/cohort/group_report.h"
#include "myoid/results/exports/exported_project.h"
#include "myoid/run/study_result.h"
#include "myoid/study/setting.h"

namespace myoid::program {

/// Options of the report of a finished run, which is computed again from its recordings, or of the page of several.
struct ReportOptions {
  Call call;
  std::string folder;                          ///< Folder of the run, with run.json.
  study::VideoChoice video;                    ///< In place of the films that the study names.
  std::vector<results::ExportFormat> exports;  ///< Forms for other programs.
  std::string mat;                             ///< File of the results for MATLAB; empty: not written.
  std::vector<std::string> persons;            ///< In place of `folder`: runs that one page sets side by side.
  std::vector<std::string> after;              ///< The second sessions of these persons, in the same order.
  std::string out = "group";                   ///< Folder of the page of several.

  /// Returns the options of the page of several.
  [[nodiscard]] results::GroupReportOptions group() const {
    return {.persons = {persons.begin(), persons.end()}, .after = {after.begin(), after.end()}, .folder = out};
  }
};
void visit(ReportOptions& options, study::SettingVisitor& v);

struct ReportResult {
  run::StudyResult study;
  Provenance provenance;
  std::vector<results::ExportedProject> exports;
};

/// Runs the study of the folder with the run's settings. Throws ReadError if run.json lacks them,
/// or a recording has changed.
[[nodiscard]] ReportResult report(const ReportOptions& options);

/// Writes report.html, figures, tables, the page with the moving model, and the files for other programs.
void write_report(const ReportResult& result, const std::filesystem::path& folder);

}  // namespace myoid::program
