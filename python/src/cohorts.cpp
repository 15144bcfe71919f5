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
  Work work("cohort", std::move(given));
  const auto o = work.options<program::CohortOptions>();
  struct Done {
    std::vector<PersonOutcome> outcomes;
    std::string start;
  };
  const Done done = work.run([&] {
    Done d;
    program::prepare_cohort_folder(o, o.out);
    if (o.workflow) {
      d.start = program::write_cohort_workflow(o, o.out);
      return d;
    }
    if (!o.group) d.outcomes = program::write_cohort_persons(o, o.out);
    if (o.persons.empty()) {
      results::Group all = program::write_cohort_group(o, o.out);
      if (o.group) d.outcomes = std::move(all.outcomes);
    }
    return d;
  });
  py::dict d;
  d["persons"] = outcome_rows(done.outcomes);
  d["start"] = done.start;
  return d;
}

py::dict report(py::dict given) {
  Work work("report", std::move(given));
  const auto o = work.options<program::ReportOptions>();
  if (o.folder.empty() && o.persons.empty()) throw InvalidInput("give the folder of a run, or group with several");
  const std::string folder = o.persons.empty() ? o.folder : o.out;
  (void)work.run([&] {
    if (!o.persons.empty()) {
      ResultOut held(o.out, o.call);
      page::write_report(results::group_report(o.group()), o.out);
      held.finish();
      return true;
    }
    if (!o.mat.empty()) results::check_mat_file(o.mat);
    if (!o.mat.empty()) check_output(o.mat, {}, o.call.overwrite);
    const program::ReportResult result = program::report(o);
    const std::string author = author_of(std::filesystem::path(o.folder) / "run.json");
    ResultFolder held(o.folder, o.call.command, author.empty() ? "run" : author, true);
    program::write_report(result, o.folder);
    if (!o.mat.empty()) results::write_results_mat(o.folder, o.mat);
    held.finish();
    return true;
  });
  py::dict d;
  d["file"] = (std::filesystem::path(folder) / "report.html").string();
  return d;
}

py::dict init(py::dict given) {
  Work work("init", std::move(given));
  const auto o = work.options<program::InitOptions>();
  const std::filesystem::path file = program::study_file(o);
  const program::InitResult result = work.run([&] {
    check_output(file, {}, o.call.overwrite);
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
