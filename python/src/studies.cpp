#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "myoid/ground/core/choice.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/output_file.h"
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
#include "keywords.h"
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
  Keywords k("check", std::move(given));
  Work work(k);
  program::CheckOptions o;
  k.take("study", o.input);
  k.take("model", o.model);
  k.word("up", o.up, {"x", "y", "z", "-x", "-y", "-z"});
  k.refuse_others();
  o.call = work.call();
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
  Keywords k("run", std::move(given));
  Work work(k);
  program::RunOptions o;
  std::string out, mat;
  bool overwrite = false;
  k.take("study", o.study);
  k.take("out", out);
  k.take("mat", mat);
  k.choices("method", o.methods);
  k.choices("export", o.exports);
  k.take("video", o.video.files);
  k.take("video_offset", o.video.offset_s);
  k.take("overwrite", overwrite);
  k.refuse_others();
  o.store = std::filesystem::path(out) / program::kStageFolder;
  o.call = work.call();
  return run_values(work.run([&] {
    prepare_mat(mat, o.study, overwrite);
    ResultOut folder(out, o.call, overwrite, program::kStageFolder);
    program::RunResult r = program::run(o);
    program::write_run(r, out);
    if (!mat.empty()) results::write_results_mat(out, mat);
    folder.finish();
    return r;
  }));
}

/// Sets the settings of a struct from the arguments of their names, with '_' for '-'.
class KeywordReader : public study::FlatSettingVisitor {
 public:
  explicit KeywordReader(Keywords& keywords) : keywords_(&keywords) {}

 protected:
  bool met(const study::Setting& setting, const study::SettingValue& /*now*/, const Set& set) override {
    std::string name(setting.key);
    for (char& c : name) c = c == '-' ? '_' : c;
    if (name == "from") name = "from_";  // a word of the language
    const char* const key = name.c_str();
    if (!keywords_->object(key)) return false;
    study::SettingValue given = value(setting, key);
    if (const auto* word = std::get_if<std::string>(&given)) {
      const std::string reason = study::refusal(setting, *word);
      if (!reason.empty()) throw InvalidInput(fmt::format("{}: {}", name, reason));
    }
    set(std::move(given));
    return true;
  }

 private:
  study::SettingValue value(const study::Setting& setting, const char* key) {
    if (setting.kind == study::SettingKind::flag) return taken<bool>(key);
    if (setting.kind == study::SettingKind::number || setting.kind == study::SettingKind::count)
      return taken<double>(key);
    if (setting.kind == study::SettingKind::texts) return taken<std::vector<std::string>>(key);
    return taken<std::string>(key);
  }
  template <typename Value>
  study::SettingValue taken(const char* key) {
    Value value{};
    keywords_->take(key, value);
    return value;
  }

  Keywords* keywords_;
};

py::dict identify(py::dict given) {
  Keywords k("identify", std::move(given));
  Work work(k);
  program::IdentifyOptions o;
  KeywordReader reader(k);
  visit(o, reader);
  std::string out, mat;
  bool overwrite = false;
  k.take("out", out);
  k.take("mat", mat);
  k.choices("export", o.exports);
  k.take("overwrite", overwrite);
  k.refuse_others();
  o.call = work.call();
  const program::IdentifyResult done = work.run([&] {
    prepare_mat(mat, o.muscles.string(), overwrite);
    ResultOut folder(out, o.call, overwrite);
    o.folder = out;
    protect_files(out, program::kIdentifyFiles, {o.muscles.string()});
    program::IdentifyResult r = program::identify(o);
    program::write_identify(r, out);
    if (!mat.empty()) results::write_results_mat(out, mat);
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
  Keywords k("compare", std::move(given));
  Work work(k);
  program::CompareOptions o;
  std::string out;
  bool overwrite = false;
  k.take("first", o.first);
  k.take("second", o.second);
  k.take("out", out);
  k.take("overwrite", overwrite);
  k.refuse_others();
  o.call = work.call();
  const program::CompareResult result = work.run([&] {
    ResultOut folder(out, o.call, overwrite);
    program::CompareResult r = program::compare(o);
    if (!out.empty()) program::write_compare(r, out);
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
    d["p_value"] = optional(p.p_value);
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
  Keywords k("review", std::move(given));
  Work work(k);
  program::ReviewOptions o;
  bool overwrite = false;
  k.take("project", o.project);
  k.take("joint", o.joints);
  k.take("out", o.folder);
  k.take("overwrite", overwrite);
  k.refuse_others();
  o.call = work.call();
  const program::ReviewResult result = work.run([&] {
    ResultOut folder(o.folder, o.call, overwrite);
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
  Keywords k("predict", std::move(given));
  Work work(k);
  program::PredictOptions o;
  std::string out;
  bool overwrite = false;
  k.take("folder", o.folder);
  k.take("study", o.study);
  k.take("trials", o.trials);
  k.take("out", out);
  k.take("overwrite", overwrite);
  k.refuse_others();
  o.call = work.call();
  struct Done {
    std::vector<std::string> trials;
    std::vector<Remark> remarks;
  };
  const Done done = work.run([&] {
    ResultOut folder(out, o.call, overwrite);
    const program::PredictResult r = program::predict(o);
    program::write_predict(r, out);
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

program::DesignOptions design_options(Keywords& k) {
  program::DesignOptions o;
  bool no_dynamometer = false;
  k.take("study", o.study);
  k.take("model", o.model);
  k.take("wire", o.wire);
  k.take("targets", o.design.targets);
  k.take("after", o.after);
  std::string criterion(choice_name(o.design.choice.criterion));
  k.word("criterion", criterion, {"D", "A"});
  o.design.choice.criterion = *choice_named<run::DesignCriterion>(criterion);
  k.count("movements", o.design.choice.movements, 1, 50);
  k.count("repeat", o.design.choice.most_of_each, 1, 50);
  k.above_zero("budget", o.design.choice.budget_s);
  k.within("fatigue", o.design.fatigued_share, 0.001, 1.0);
  k.take("masses", o.design.catalogue.held_masses_kg);
  for (const double mass_kg : o.design.catalogue.held_masses_kg)
    if (!(mass_kg >= 0.0)) throw InvalidInput("masses: expected numbers of 0 or more [kg]");
  k.take("no_dynamometer", no_dynamometer);
  k.count("persons", o.design.persons, 1, 1000);
  k.above_zero("torque_noise", o.design.torque_sd_nm);
  k.within("emg_noise", o.design.emg_cv, 0.0, 1.0);
  o.dynamometer = !no_dynamometer;
  return o;
}

py::dict design(py::dict given) {
  Keywords k("design", std::move(given));
  Work work(k);
  program::DesignOptions o = design_options(k);
  k.refuse_others();
  o.call = work.call();
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
