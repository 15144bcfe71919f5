#include "myoid/commands/report.h"

#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/core/error.h"
#include "myoid/files/text_file.h"
#include "myoid/report/write_report.h"
#include "myoid/results/study_report.h"
#include "myoid/results/study_workbench.h"
#include "myoid/run/run_study.h"
#include "myoid/study/read_study.h"
#include "myoid/study/study_text.h"

namespace myoid::commands {
namespace {

namespace fs = std::filesystem;

nlohmann::ordered_json read_record(const fs::path& path) {
  nlohmann::ordered_json run;
  try {
    run = nlohmann::ordered_json::parse(recording::read_text_file(path));
  } catch (const nlohmann::json::exception& error) {
    throw ReadError(path, 0,
                    fmt::format("not a run's record: {}; run the study again", error.what()));
  }
  if (!run.contains("study"))
    throw ReadError(path, 0, "does not name its study; run the study again");
  return run;
}

std::optional<double> number_of(const nlohmann::ordered_json& run, const char* key) {
  if (!run.contains(key) || !run[key].is_number()) return std::nullopt;
  return run[key].get<double>();
}

void refuse_changed(const std::vector<InputFile>& inputs,
                    const nlohmann::ordered_json& run,
                    const std::string& folder) {
  if (!run.contains("inputs")) return;
  for (const InputFile& now : inputs) {
    for (const auto& recorded : run["inputs"]) {
      if (fs::path(recorded["path"].get<std::string>()).filename() !=
              fs::path(now.path).filename() ||
          recorded["sha256"] == now.sha256)
        continue;
      throw ReadError(
          now.path, 0,
          fmt::format("has changed since the run in {}; run the study again (myoid run)", folder));
    }
  }
}

}  // namespace

ReportResult report(const ReportOptions& o) {
  const nlohmann::ordered_json run = read_record(fs::path(o.folder) / "run.json");
  const Study study = read_study(run["study"].get<std::string>());
  ReportResult result;
  result.study = run_study(study, {.start_s = number_of(run, "start_s"),
                                   .end_s = number_of(run, "end_s"),
                                   .progress = o.call.progress});
  refuse_changed(result.study.source.files, run, o.folder);
  result.provenance.command = run.value("command", o.call.command);
  result.provenance.inputs = result.study.source.files;
  result.provenance.options_json = study_json(result.study.source.study);
  return result;
}

void write_report(const ReportResult& result, const fs::path& folder) {
  const report::Workbench workbench = study_workbench(result.study);
  report::write_report(study_report(result.study, result.provenance), folder, &workbench);
}

}  // namespace myoid::commands
