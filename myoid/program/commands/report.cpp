#include "myoid/program/commands/report.h"

#include "myoid/page/write_report.h"
#include "myoid/results/exports/export_files.h"
#include "myoid/results/study_days.h"
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

ReportResult report(const ReportOptions& o) {
  const study::RunRecord run = study::read_run_record(o.folder);
  ReportResult result;
  result.study = run::run_study(
      study::read_filmed_study(run.study, o.video),
      {.start_s = run.start_s, .end_s = run.end_s, .progress = o.call.progress, .stage_ended = o.call.stage_ended});
  results::add_days(result.study);
  study::refuse_changed(result.study.source.files, run);
  result.provenance.command = run.command.empty() ? o.call.command : run.command;
  result.provenance.inputs = result.study.source.files;
  result.provenance.options_json = study::study_json(result.study.source.study);
  Remarks remarks(o.call);
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
