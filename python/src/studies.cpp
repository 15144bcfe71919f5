#include <string>
#include <utility>
#include <vector>

#include "myoid/ground/core/choice.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/output_file.h"
#include "myoid/ground/files/result_names.h"
#include "myoid/program/commands/check.h"
#include "myoid/program/commands/compare.h"
#include "myoid/program/commands/design.h"
#include "myoid/program/commands/identify.h"
#include "myoid/program/commands/predict.h"
#include "myoid/program/commands/review.h"
#include "myoid/program/commands/run.h"
#include "myoid/results/mat/results_mat.h"
#include "myoid/results/review/review_report.h"

#include "bindings.h"
#include "result_out.h"
#include "to_python.h"
#include "work.h"

namespace myoid::python {
namespace {

const char* status_name(page::GateStatus status) {
  switch (status) {
    case page::GateStatus::pass:
      return "pass";
    case page::GateStatus::warn:
      return "warn";
    case page::GateStatus::fail:
      return "fail";
    case page::GateStatus::info:
      return "info";
  }
  return "info";
}

py::list gate_rows(const std::vector<page::Gate>& gates) {
  py::list rows;
  for (const page::Gate& gate : gates) {
    py::dict d;
    d["name"] = gate.name;
    d["status"] = status_name(gate.status);
    d["value"] = gate.value;
    d["threshold"] = gate.threshold;
    d["why"] = gate.why;
    rows.append(d);
  }
  return rows;
}

py::dict check(py::dict given) {
  Work work("check", std::move(given));
  const auto o = work.options<program::CheckOptions>();
  const program::CheckResult result = work.run([&] { return program::check(o); });
  py::dict d;
  d["findings"] = to_python(result.findings);
  d["of_study"] = result.of_study;
  d["trials"] = result.trials;
  d["muscles"] = result.muscles;
  d["errors"] = result.errors;
  return d;
}

/// Refuses a MATLAB file that cannot be written, before anything is computed.
void prepare_mat(const std::string& file, const std::string& input, bool overwrite) {
  if (file.empty()) return;
  results::check_mat_file(file);
  check_output(file, {input}, overwrite);
}

/// The values of a run for Python.
py::dict run_values(const program::RunResult& run) {
  py::dict d;
  d["gates"] = gate_rows(run.gates);
  d["failed"] = run.failed(false);
  d["remarks"] = to_python(run.remarks);
  return d;
}

py::dict run(py::dict given) {
  Work work("run", std::move(given));
  auto o = work.options<program::RunOptions>();
  o.store = std::filesystem::path(o.out) / program::kStageFolder;
  return run_values(work.run([&] {
    prepare_mat(o.mat, o.study, o.call.overwrite);
    ResultOut folder(o.out, o.call, program::kStageFolder);
    protect_files(o.out, run_result_names(), {o.study});
    program::RunResult r = program::run(o);
    program::write_run(r, o.out);
    if (!o.mat.empty()) results::write_results_mat(o.out, o.mat);
    folder.finish();
    return r;
  }));
}

py::dict identify(py::dict given) {
  Work work("identify", std::move(given));
  const auto o = work.options<program::IdentifyOptions>();
  const program::IdentifyResult done = work.run([&] {
    prepare_mat(o.mat, o.muscles.string(), o.call.overwrite);
    ResultOut folder(o.folder, o.call);
    protect_files(o.folder, program::identify_files(), {o.muscles.string()});
    program::IdentifyResult r = program::identify(o);
    program::write_identify(r, o.folder);
    if (!o.mat.empty()) results::write_results_mat(o.folder, o.mat);
    folder.finish();
    return r;
  });
  py::dict d = run_values(done.run);
  const fit::IdentificationResult& fit = done.fit();
  d["undetermined"] = fit.open_sums;
  d["diagnoses"] = sentences(fit.diagnoses);
  d["message"] = fit.message;
  d["converged"] = fit.termination == math::Termination::converged;
  d["r2"] = fit.r2;
  return d;
}

py::object optional(const std::optional<double>& value) {
  return value ? py::object(py::float_(*value)) : py::object(py::none());
}

py::dict compare(py::dict given) {
  Work work("compare", std::move(given));
  const auto o = work.options<program::CompareOptions>();
  const program::CompareResult result = work.run([&] {
    ResultOut folder(o.out, o.call);
    program::CompareResult r = program::compare(o);
    if (!o.out.empty()) program::write_compare(r, o.out);
    folder.finish();
    return r;
  });
  py::list rows;
  for (const results::ComparedParameter& p : result.comparison.parameters) {
    py::dict d;
    d["muscle"] = p.muscle;
    d["parameter"] = p.first.parameter;
    d["unit"] = std::string(symbol(p.first.unit));
    d["method"] = std::string(fit::name(p.first.method));
    d["case"] = std::string(fit::name(p.first.fit_case));
    d["first"] = p.first.estimate;
    d["second"] = p.second.estimate;
    d["difference"] = p.difference;
    d["smallest_detectable"] = optional(p.smallest_detectable);
    d["p_alone"] = optional(p.p_alone);
    d["p_value"] = optional(p.p_value);
    d["tested"] = p.tested;
    d["change"] = std::string(results::name(p.change));
    rows.append(d);
  }
  py::dict d;
  d["parameters"] = rows;
  d["unlike"] = result.comparison.unlike;
  d["notes"] = sentences(result.comparison.remarks);
  d["remarks"] = to_python(result.remarks);
  return d;
}

py::object score_of(const std::optional<fit::Score>& score, double (fit::Score::*value)() const) {
  return score ? py::object(py::float_(((*score).*value)())) : py::object(py::none());
}

py::list torque_rows(const results::SecondOpinion& opinion) {
  py::list torques;
  for (const results::ReviewedTorque& t : opinion.torques) {
    py::dict d;
    d["trial"] = t.trial;
    d["joint"] = t.joint;
    d["calibration"] = t.is_calibrating;
    d["their_r2"] = score_of(t.theirs, &fit::Score::r2);
    d["their_rmse_nm"] = score_of(t.theirs, &fit::Score::rmse_nm);
    d["left_out_r2"] = score_of(t.ours, &fit::Score::r2);
    d["left_out_rmse_nm"] = score_of(t.ours, &fit::Score::rmse_nm);
    torques.append(d);
  }
  return torques;
}

py::list number_rows(const results::SecondOpinion& opinion) {
  py::list numbers;
  for (const results::ReviewedNumber& n : opinion.numbers) {
    py::dict d;
    d["muscle"] = n.muscle;
    d["muscles"] = n.lumped;
    d["parameter"] = n.ours.parameter;
    d["unit"] = std::string(symbol(n.ours.unit));
    d["start"] = optional(n.start);
    d["calibrated"] = n.theirs;
    d["on_bound"] = n.on_bound;
    d["estimate"] = n.ours.estimate;
    d["ci_low"] = optional(n.ours.ci_low);
    d["ci_high"] = optional(n.ours.ci_high);
    d["verdict"] = std::string(fit::name(n.ours.verdict));
    d["standing"] = std::string(choice_name(n.standing));
    numbers.append(d);
  }
  return numbers;
}

py::list strength_rows(const results::SecondOpinion& opinion) {
  py::list strengths;
  for (const results::JointStrength& s : opinion.strengths) {
    py::dict d;
    d["joint"] = s.joint;
    d["direction"] = s.is_positive ? 1 : -1;
    d["strength_nm"] = s.all_nm;
    d["without_emg_nm"] = s.without_emg_nm;
    d["without_emg"] = s.without_emg;
    strengths.append(d);
  }
  return strengths;
}

py::dict review(py::dict given) {
  Work work("review", std::move(given));
  const auto o = work.options<program::ReviewOptions>();
  const program::ReviewResult result = work.run([&] {
    ResultOut folder(o.folder, o.call);
    program::ReviewResult r = program::review(o);
    program::write_review(r, o.folder);
    folder.finish();
    return r;
  });
  const results::SecondOpinion& opinion = result.opinion;
  py::dict d;
  d["torques"] = torque_rows(opinion);
  d["numbers"] = number_rows(opinion);
  d["strengths"] = strength_rows(opinion);
  d["says"] = results::review_sentences(opinion);
  d["remarks"] = to_python(result.remarks);
  return d;
}

py::dict predict(py::dict given) {
  Work work("predict", std::move(given));
  const auto o = work.options<program::PredictOptions>();
  struct Done {
    std::vector<std::string> trials;
    std::vector<Remark> remarks;
  };
  const Done done = work.run([&] {
    ResultOut folder(o.out, o.call);
    const program::PredictResult r = program::predict(o);
    program::write_predict(r, o.out);
    folder.finish();
    std::vector<std::string> trials;
    for (const fit::TrialFit& trial : r.trials)
      if (trials.empty() || trials.back() != trial.trial) trials.push_back(trial.trial);
    return Done{.trials = trials, .remarks = r.remarks};
  });
  py::dict d;
  d["trials"] = done.trials;
  d["remarks"] = to_python(done.remarks);
  return d;
}

py::list expected_rows(const std::vector<fit::ParameterEstimate>& estimates) {
  py::list rows;
  for (const fit::ParameterEstimate& e : estimates) {
    py::dict d;
    d["muscle"] = e.muscle;
    d["parameter"] = e.parameter;
    d["unit"] = std::string(symbol(e.unit));
    d["value"] = e.estimate;
    d["ci_low"] = optional(e.ci_low);
    d["ci_high"] = optional(e.ci_high);
    d["verdict"] = std::string(fit::name(e.verdict));
    rows.append(d);
  }
  return rows;
}

py::dict design(py::dict given) {
  Work work("design", std::move(given));
  const auto o = work.options<program::DesignOptions>();
  const program::DesignResult result = work.run([&] { return program::design(o); });
  py::list plan, expected;
  for (const run::PlannedMovement& m : result.design.plan) {
    py::dict d;
    d["movement"] = m.movement.description();
    d["duration_s"] = m.movement.duration_s;
    d["rest_before_s"] = m.rest_before_s;
    d["fatigued_share"] = m.fatigued_share;
    plan.append(d);
    expected.append(expected_rows(m.expected));
  }
  py::dict d;
  d["plan"] = plan;
  d["expected"] = expected;
  d["beforehand"] = expected_rows(result.design.beforehand);
  d["catalogue_size"] = result.design.catalogue_size;
  d["remarks"] = to_python(result.remarks);
  return d;
}

}  // namespace

void bind_studies(py::module_& module) {
  module.def("check", &check);
  module.def("run", &run);
  module.def("identify", &identify);
  module.def("predict", &predict);
  module.def("compare", &compare);
  module.def("review", &review);
  module.def("design", &design);
}

}  // namespace myoid::python
