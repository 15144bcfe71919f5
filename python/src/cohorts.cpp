#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "myoid/ground/core/choice.h"
#include "myoid/ground/files/output_file.h"
#include "myoid/ground/files/result_folder.h"
#include "myoid/page/write_report.h"
#include "myoid/program/commands/cohort.h"
#include "myoid/program/commands/init.h"
#include "myoid/program/commands/report.h"
#include "myoid/results/cohort/group_report.h"
#include "myoid/results/mat/results_mat.h"
#include "myoid/study/read_study.h"
#include "myoid/study/run_record.h"
#include "myoid/study/setting_rows.h"
#include "myoid/study/study_text.h"

#include "bindings.h"
#include "keywords.h"
#include "result_out.h"
#include "to_python.h"
#include "work.h"

namespace myoid::python {
namespace {

using results::PersonOutcome;

py::list outcome_rows(const std::vector<PersonOutcome>& outcomes) {
  py::list rows;
  for (const PersonOutcome& each : outcomes) {
    py::dict d;
    d["person"] = each.person;
    d["outcome"] = each.outcome ? std::string(choice_name(each.outcome->kind)) : "not computed";
    d["message"] = each.outcome ? each.outcome->message : "";
    d["reused"] = each.reused;
    rows.append(d);
  }
  return rows;
}

py::dict cohort(py::dict given) {
  Keywords k("cohort", std::move(given));
  Work work(k);
  program::CohortOptions o;
  std::string out;
  bool group = false;
  std::vector<results::Engine> engines;
  k.take("manifest", o.manifest);
  k.take("study", o.study);
  k.take("person", o.persons);
  k.take("group", group);
  k.choices("workflow", engines);
  std::vector<std::string> sessions, tasks;
  std::string filter;
  k.take("session_label", sessions);
  k.take("task_label", tasks);
  k.take("bids_filter_file", filter);
  if (!sessions.empty()) o.filter["ses"] = sessions;
  if (!tasks.empty()) o.filter["task"] = tasks;
  if (!filter.empty()) results::add_bids_filter(filter, o.filter);
  std::vector<page::Kept> kept;
  std::string work_dir;
  k.choices("keep", kept);
  k.take("work_dir", work_dir);
  k.count("jobs", o.jobs, 1, 1024);
  k.take("out", out);
  k.take("overwrite", o.overwrite);
  k.refuse_others();
  if (group && !o.persons.empty()) throw InvalidInput("group and person exclude each other");
  if (!engines.empty() && (group || !o.persons.empty()))
    throw InvalidInput("workflow computes nothing: leave out group and person");
  if (!kept.empty()) o.kept = kept.front();
  o.work = work_dir;
  o.call = work.call();
  struct Done {
    std::vector<PersonOutcome> outcomes;
    std::string start;
  };
  const Done done = work.run([&] {
    Done d;
    program::prepare_cohort_folder(o, out);
    if (!engines.empty()) {
      d.start = program::write_cohort_workflow(o, engines.front(), out);
      return d;
    }
    if (!group) d.outcomes = program::write_cohort_persons(o, out);
    if (o.persons.empty()) {
      results::Group all = program::write_cohort_group(o, out);
      if (group) d.outcomes = std::move(all.outcomes);
    }
    return d;
  });
  py::dict d;
  d["persons"] = outcome_rows(done.outcomes);
  d["start"] = done.start;
  return d;
}

py::dict report(py::dict given) {
  Keywords k("report", std::move(given));
  Work work(k);
  program::ReportOptions o;
  std::vector<std::string> persons, after;
  std::string out = "group", mat;
  bool overwrite = false;
  k.take("folder", o.folder);
  k.take("video", o.video.files);
  k.take("video_offset", o.video.offset_s);
  k.choices("export", o.exports);
  k.take("group", persons);
  k.take("after", after);
  k.take("out", out);
  k.take("mat", mat);
  k.take("overwrite", overwrite);
  k.refuse_others();
  if (o.folder.empty() == persons.empty()) throw InvalidInput("give the folder of a run, or group with several");
  o.call = work.call();
  const std::string folder = persons.empty() ? o.folder : out;
  (void)work.run([&] {
    if (!persons.empty()) {
      ResultOut held(out, o.call, overwrite);
      page::write_report(
          results::group_report(
              {.persons = {persons.begin(), persons.end()}, .after = {after.begin(), after.end()}, .folder = out}),
          out);
      held.finish();
      return true;
    }
    if (!mat.empty()) results::check_mat_file(mat);
    if (!mat.empty()) check_output(mat, {}, overwrite);
    const program::ReportResult result = program::report(o);
    const std::string author = author_of(std::filesystem::path(o.folder) / "run.json");
    ResultFolder held(o.folder, o.call.command, author.empty() ? "run" : author, true);
    program::write_report(result, o.folder);
    if (!mat.empty()) results::write_results_mat(o.folder, mat);
    held.finish();
    return true;
  });
  py::dict d;
  d["file"] = (std::filesystem::path(folder) / "report.html").string();
  return d;
}

py::dict init(py::dict given) {
  Keywords k("init", std::move(given));
  Work work(k);
  program::InitOptions o;
  bool overwrite = false;
  k.take("dir", o.folder);
  k.take("from_", o.from);
  k.take("model", o.model);
  k.take("coordinate", o.coordinate);
  k.take("overwrite", overwrite);
  k.refuse_others();
  o.call = work.call();
  const std::filesystem::path file = std::filesystem::path(o.folder) / "study.toml";
  const program::InitResult result = work.run([&] {
    check_output(file, {}, overwrite);
    program::InitResult r = program::init(o);
    program::write_init(r, file, o.call);
    return r;
  });
  py::dict d;
  d["file"] = file.string();
  d["todo"] = result.draft.todo;
  d["remarks"] = to_python(result.remarks);
  return d;
}

/// The settings of a study with their defaults, or the reference of all settings, as text of JSON.
std::string settings(const std::string& study) {
  const py::gil_scoped_release others_may_run;
  return study.empty() ? study::reference_json(study::setting_tables()) : study::study_json(study::read_study(study));
}

}  // namespace

void bind_cohorts(py::module_& module) {
  module.def("cohort", &cohort);
  module.def("report", &report);
  module.def("init", &init);
  module.def("settings", &settings);
}

}  // namespace myoid::python
