#include "myoid/program/commands/identify.h"

#include <string>
#include <utility>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/result_names.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/program/commands/identify_study.h"
#include "myoid/program/commands/project_files.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/study/study_text.h"

namespace myoid::program {

namespace {

/// Runs the study, and puts the remarks before those of the run.
IdentifyResult run_of(study::Study study, const IdentifyOptions& o, Remarks& remarks) {
  IdentifyResult result{.study = std::move(study), .run = {}};
  RunOptions options;
  options.call = o.call;
  options.call.start_s = options.call.end_s = std::nullopt;  // they are the trials' now
  options.exports = o.exports;
  result.run = run(result.study, options);
  if (o.beliefs && o.method != fit::Method::paper)
    result.run.provenance.inputs.push_back({o.beliefs->string(), sha256(read_text_file(*o.beliefs))});
  for (const Remark& remark : result.fit().warnings) remarks.add(remark);
  std::vector<Remark> all = remarks.list();
  all.insert(all.end(), result.run.remarks.begin(), result.run.remarks.end());
  result.run.remarks = std::move(all);
  return result;
}

IdentifyResult identify_project(const IdentifyOptions& o, Remarks& remarks) {
  if (o.method != fit::Method::torque) throw InvalidInput("--from: a project holds torques; use --method torque");
  refuse_inside(o.from, o.folder);
  ProjectOfStudy of = project_of_study(o.from, o.files.coordinates, o.folder, remarks);
  of.study.study = with_choices(std::move(of.study.study), o);
  write_project_study(of.study, o.folder);
  return run_of(std::move(of.study.study), o, remarks);
}

}  // namespace

IdentifyResult identify(const IdentifyOptions& o) {
  check_options(o);
  Remarks remarks(o.call);
  if (!o.from.empty()) return identify_project(o, remarks);
  const run::MuscleTable table = run::read_muscles_csv(o.muscles, o.method != fit::Method::paper);
  refuse_impossible(o, table);
  for (const std::string& text : without_effect(o)) remarks.warn(text);
  for (const Remark& remark : table.remarks) remarks.add(remark);
  return run_of(identify_study(o, table, remarks), o, remarks);
}

std::vector<std::string_view> identify_files() {
  std::vector<std::string_view> names = run_result_names();
  names.emplace_back("study.toml");
  return names;
}

void write_identify(IdentifyResult& result, const std::filesystem::path& folder) {
  study::Study study = seen_from(folder, result.study);
  const std::string text = study::study_toml(study);
  const std::filesystem::path file = folder / study.file;
  // First, because the run's record names it.
  result.run.study.source.study.file = file;
  result.run.provenance.inputs.push_back({file.string(), sha256(text)});
  write_run(result.run, folder);
  write_file(file, text);
}

}  // namespace myoid::program
