#include "myoid/program/commands/review.h"

#include <utility>

#include "myoid/ground/files/atomic_file.h"
#include "myoid/opensim/projects/read_project.h"
#include "myoid/page/write_report.h"
#include "myoid/program/commands/project_files.h"
#include "myoid/program/commands/run.h"
#include "myoid/results/review/review_report.h"
#include "myoid/run/run_study.h"

namespace myoid::program {

void visit(ReviewOptions& o, study::SettingVisitor& v) {
  v.path("project", o.project,
         {.says = "Folder, set-up or subject of the project.", .required = "a project", .option = {.by_place = true}});
  v.texts("joint", o.joints, {.says = "Joints to judge.", .otherwise = "those of the calibration"});
  v.folder("out", o.folder, {.says = "Folder for report.html, tables, figures and study.toml."});
}

ReviewResult review(const ReviewOptions& o) {
  Remarks remarks(o.call);
  refuse_inside(o.project, o.folder);
  ProjectOfStudy of = project_of_study(o.project, o.joints, o.folder, remarks);
  write_project_study(of.study, o.folder);
  if (const std::string idle = seed_without_effect(of.study.study, o.call); !idle.empty()) remarks.warn(idle);
  ReviewResult result;
  run::StudyResult fitted = run::run_study(of.study.study, {.start_s = o.call.start_s,
                                                            .end_s = o.call.end_s,
                                                            .seed = o.call.seed,
                                                            .progress = o.call.progress,
                                                            .stage_ended = o.call.stage_ended,
                                                            .share_forces = false,
                                                            .inform_forces = false});
  result.opinion = results::second_opinion(std::move(of.project), std::move(of.joints), std::move(fitted));
  result.remarks = remarks.list();
  return result;
}

void write_review(const ReviewResult& result, const std::filesystem::path& folder) {
  page::write_report(results::review_report(result.opinion), folder);
}

}  // namespace myoid::program
