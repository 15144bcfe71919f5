#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/measurement/options.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/page/report.h"
#include "myoid/page/write_report.h"
#include "myoid/program/steps/call.h"
#include "myoid/results/exports/exported_project.h"
#include "myoid/run/study_result.h"
#include "myoid/study/setting.h"

namespace myoid::program {

/// Folder in the folder of the results with the stages that a repeated run need not compute again.
inline constexpr const char* kStageFolder = ".stages";

/// Options of the whole pipeline, from a study's recordings to muscle parameters.
struct RunOptions {
  Call call;
  std::string study;                           ///< study.toml
  std::vector<fit::Method> methods;            ///< In place of the study's; empty: the study's.
  study::VideoChoice video;                    ///< In place of the study's films.
  std::vector<results::ExportFormat> exports;  ///< Forms for other programs, beside the model.
  std::optional<std::filesystem::path> store;  ///< Keeps stages between runs; empty: none.
  std::string out;                             ///< Folder of `write_run`.
  std::string mat;                             ///< File of the results for MATLAB; empty: not written.
};
void visit(RunOptions& options, study::SettingVisitor& v);

/// Visits the films that the report shows beside the model.
void visit_videos(study::VideoChoice& video, study::SettingVisitor& v);
/// Visits the forms for other programs.
void visit_exports(std::vector<results::ExportFormat>& formats, study::SettingVisitor& v);
/// Visits the file of the results for MATLAB.
void visit_mat(std::string& mat, study::SettingVisitor& v);

struct RunResult {
  run::StudyResult study;
  std::vector<page::Gate> gates;
  std::vector<results::ExportedProject> exports;  ///< Without `osim`.
  std::size_t reading_remarks = 0;                ///< Remarks of the kind `detail`.
  Provenance provenance;
  std::vector<Remark> remarks;

  /// Returns true if a gate failed, or method torque or force did not converge; with `strict` also if such a method has
  /// a parameter that is not identifiable.
  [[nodiscard]] bool failed(bool strict) const;
};

[[nodiscard]] RunResult run(const RunOptions& options);

/// Runs a study that no file holds yet; `options.study` is not read.
[[nodiscard]] RunResult run(const study::Study& study, const RunOptions& options);

/// Returns the sentence that a seed has no effect on a study; empty for the usual one, and where solvers are compared:
/// nothing else draws numbers by the call's seed.
[[nodiscard]] std::string seed_without_effect(const study::Study& study, const Call& call);

/// Writes all results and the report, in the place of the files of an earlier run.
void write_run(const RunResult& result, const std::filesystem::path& folder, page::Kept kept = page::Kept::all);

}  // namespace myoid::program
