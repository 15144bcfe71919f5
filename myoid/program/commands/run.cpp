#include "myoid/program/commands/run.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "myoid/ground/files/result_record.h"
#include "myoid/page/write_report.h"
#include "myoid/program/commands/study_days.h"
#include "myoid/results/exports/export_files.h"
#include "myoid/results/result_files.h"
#include "myoid/results/study_report.h"
#include "myoid/results/study_workbench.h"
#include "myoid/run/quality_gates.h"
#include "myoid/run/recording_faults.h"
#include "myoid/run/run_study.h"
#include "myoid/study/checks/recording_findings.h"
#include "myoid/study/study_model.h"
#include "myoid/study/study_text.h"
#include "myoid/study/trial_videos.h"

namespace myoid::program {
namespace {

/// Reports the faults of recordings and trials and the repairs of files; returns the count of repairs.
std::size_t tell_trials(const run::StudyResult& study, Remarks& remarks) {
  const auto reused =
      std::ranges::count_if(study.trials, [](const run::TrialResult& trial) { return trial.motion.ik_reused; });
  if (reused > 0) remarks.note(fmt::format("inverse kinematics of {} trials reused: same input as before", reused));
  const auto damaged =
      std::ranges::count_if(study.trials, [](const run::TrialResult& trial) { return trial.motion.ik_was_damaged; });
  if (damaged > 0)
    remarks.warn(fmt::format("kept inverse kinematics of {} trials changed on the disk; computed again", damaged));
  for (const std::string& line : study::fault_summary(run::all_faults(study))) remarks.warn(line);
  for (const Remark& warning : run::trial_warnings(study))
    remarks.warn(fmt::format("trial {}: {}", warning.where, sentence(warning)));
  std::size_t details = 0;
  for (const run::TrialResult& trial : study.trials) {
    if (!trial.failure().empty()) remarks.warn(fmt::format("trial {}: {}", trial.spec.name, trial.failure()));
    const std::vector<std::string> notes = sentences(trial.remarks, Severity::note);
    for (const std::string& note : notes) remarks.detail(fmt::format("{}: {}", trial.spec.name, note));
    details += notes.size();
  }
  return details;
}

}  // namespace

bool RunResult::failed(bool strict) const {
  bool failed =
      std::ranges::any_of(gates, [](const page::Gate& gate) { return gate.status == page::GateStatus::fail; });
  for (const fit::IdentificationResult& method : study.fit.methods) {
    if (method.method == fit::Method::paper) continue;
    failed = failed || method.termination != math::Termination::converged;
    for (const fit::ParameterEstimate& e : method.estimates)
      failed = failed || (strict && e.verdict == fit::Verdict::not_identifiable);
  }
  return failed;
}

void visit_videos(study::VideoChoice& video, study::SettingVisitor& v) {
  v.texts("video", video.files,
          {.says = "Film that the report shows beside the model, [TRIAL=]FILE; may be repeated.",
           .option = {.one_each = true}});
  v.number("video-offset", video.offset_s,
           {.says = "When these films begin, in seconds of the motion.", .otherwise = "0"});
}

void visit_exports(std::vector<results::ExportFormat>& formats, study::SettingVisitor& v) {
  v.choices("export", formats,
            {.says = "Muscles for [other programs](run.md#other-programs), by comma; osim, the identified model, needs "
                     "no asking: it "
                     "is written where the fit identifies a number.",
             .option = {.by_comma = true, .one_each = true}});
}

void visit_mat(std::string& mat, study::SettingVisitor& v) {
  v.path("mat", mat, {.says = "Also write the results as [one MATLAB file](matlab.md#one-matlab-file) (.mat)."});
}

void visit(RunOptions& o, study::SettingVisitor& v) {
  v.path("study", o.study, {.says = "study.toml.", .required = "a study", .option = {.by_place = true}});
  v.choices("method", o.methods, {.says = "Several are possible.", .otherwise = "the study's"});
  v.folder("out", o.out, {.says = "Folder of the results.", .required = "a folder"});
  visit_videos(o.video, v);
  visit_exports(o.exports, v);
  visit_mat(o.mat, v);
}

RunResult run(const RunOptions& o) {
  study::Study study = study::read_filmed_study(o.study, o.video);
  if (!o.methods.empty()) {
    study.identify.methods = o.methods;
    study.identify.leaves_out_paper = false;
  }
  return run(study, o);
}

RunResult run(const study::Study& study, const RunOptions& o) {
  Remarks remarks(o.call);
  RunResult result;
  for (const std::string& text : study.identify.without_effect) remarks.warn(text);
  if (const auto left_out = study::without_paper(study)) remarks.add(*left_out);
  if (const std::string idle = seed_without_effect(study, o.call); !idle.empty()) remarks.warn(idle);
  if (const std::string assumed = study::assumed_starts(study); !assumed.empty()) remarks.warn(assumed);
  result.study = run::run_study(study, {.start_s = o.call.start_s,
                                        .end_s = o.call.end_s,
                                        .seed = o.call.seed,
                                        .progress = o.call.progress,
                                        .stage_ended = o.call.stage_ended,
                                        .store = o.store});
  add_days(result.study);
  result.gates = run::quality_gates(result.study);
  result.provenance.command = o.call.command;
  result.provenance.inputs = result.study.source.files;
  result.provenance.options_json = study::study_json(result.study.source.study);
  result.reading_remarks = tell_trials(result.study, remarks);
  result.exports = results::exported_projects(result.study, o.exports);
  for (const Remark& remark : results::remarks_of(result.exports)) remarks.add(remark);
  if (result.study.fit_input.nuisances_held) remarks.note(std::string(run::kFewRows));
  result.remarks = remarks.list();
  return result;
}

std::string seed_without_effect(const study::Study& study, const Call& call) {
  const bool compares = study.identify.compare_solvers &&
                        std::ranges::find(study.identify.methods, fit::Method::paper) != study.identify.methods.end();
  if (compares || call.seed == Call{}.seed) return "";
  return "--seed has no effect here: only compare_solvers of method paper draws numbers by it; the draws of the "
         "posterior "
         "are the same for the same data";
}

void write_run(const RunResult& result, const std::filesystem::path& folder, page::Kept kept) {
  remove_earlier_results(folder);
  results::write_results(result.study, result.provenance, folder, kept);
  results::write_exports(result.exports, folder);
  std::optional<page::Workbench> workbench;
  if (kept == page::Kept::all) workbench = results::study_workbench(result.study, folder);
  page::write_report(results::study_report(result.study, result.provenance), folder, workbench ? &*workbench : nullptr,
                     kept);
}

}  // namespace myoid::program
