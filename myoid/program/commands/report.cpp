#include "myoid/program/commands/report.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "myoid/page/write_report.h"
#include "myoid/program/commands/study_days.h"
#include "myoid/results/exports/export_files.h"
#include "myoid/results/study_report.h"
#include "myoid/results/study_workbench.h"
#include "myoid/run/run_study.h"
#include "myoid/study/run_record.h"
#include "myoid/study/study_text.h"
#include "myoid/study/trial_videos.h"

namespace myoid::program {

void visit(ReportOptions& o, study::SettingVisitor& v) {
  v.folder("folder", o.folder, {.says = "Folder of a run (with run.json).", .option = {.by_place = true}});
  visit_videos(o.video, v);
  visit_exports(o.exports, v);
  v.texts("group", o.persons,
          {.says = "Folders of runs, or folders that hold them (of a cohort, of a twin-study): one page of all.",
           .option = {.excludes = "folder,export"}});
  v.texts("after", o.after,
          {.says = "The second sessions of the same persons in the same order: what changed.",
           .option = {.needs = "group"}});
  v.folder("out", o.out, {.says = "Folder of the group's page.", .option = {.needs = "group"}});
  visit_mat(o.mat, v);
}

namespace {

/// Says that the run is computed again, why, and how long that takes by the run's own clock.
std::string computed_again(const study::RunRecord& run, bool has_stages) {
  double seconds = 0.0;
  for (const auto& [stage, time_s] : run.seconds) seconds += has_stages && stage == "motion" ? 0.0 : time_s;
  return fmt::format("{} is computed again from its recordings, {}: about {:.0f} s", run.folder.string(),
                     has_stages ? "since a run keeps its inverse kinematics and not its fit"
                                : "since the folder keeps no stage of the run",
                     std::max(seconds, 1.0));
}

}  // namespace

ReportResult report(const ReportOptions& o) {
  const study::RunRecord run = study::read_run_record(o.folder);
  Remarks remarks(o.call);
  std::optional<std::filesystem::path> store = std::filesystem::path(o.folder) / kStageFolder;
  if (!std::filesystem::is_directory(*store)) store.reset();
  ReportResult result;
  result.study = run::run_study(study::read_filmed_study(run.study, o.video),
                                {.start_s = run.start_s,
                                 .end_s = run.end_s,
                                 .progress = o.call.progress,
                                 .stage_ended = o.call.stage_ended,
                                 .files_read =
                                     [&](const std::vector<InputFile>& files) {
                                       study::refuse_changed(files, run);
                                       remarks.note(computed_again(run, store.has_value()));
                                     },
                                 .store = store});
  add_days(result.study);
  result.provenance.command = run.command.empty() ? o.call.command : run.command;
  result.provenance.inputs = result.study.source.files;
  result.provenance.options_json = study::study_json(result.study.source.study);
  result.exports = results::exported_projects(result.study, o.exports);
  for (const Remark& remark : results::remarks_of(result.exports)) remarks.add(remark);
  return result;
}

void write_report(const ReportResult& result, const std::filesystem::path& folder) {
  results::write_exports(result.exports, folder);
  const page::Workbench workbench = results::study_workbench(result.study, folder);
  page::write_report(results::study_report(result.study, result.provenance), folder, &workbench);
}

}  // namespace myoid::program
