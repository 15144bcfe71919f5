#include "myoid/pipeline/study_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/muscle/hill_muscle.h"
#include "myoid/pipeline/design_report.h"
#include "myoid/pipeline/phases_report.h"
#include "myoid/pipeline/quality_gates.h"
#include "myoid/pipeline/study_scene.h"
#include "myoid/pipeline/torque_report.h"

namespace myoid::pipeline {
namespace {

using identification::IdentificationResult;
using identification::ParameterEstimate;
using identification::Verdict;
using report::Badge;
using report::Cell;
using report::Figure;
using report::format_value;
using report::Panel;
using report::Role;
using report::Section;
using report::Series;
using report::Table;
using report::to_vector;

Badge badge(Verdict verdict) {
  switch (verdict) {
    case Verdict::identified:
      return Badge::good;
    case Verdict::weak:
      return Badge::weak;
    case Verdict::prior_dominated:
      return Badge::info;
    case Verdict::not_identifiable:
      return Badge::none;
    case Verdict::non_physical:
      return Badge::bad;
  }
  return Badge::none;
}

const IdentificationResult* method_of(const StudyResult& result, std::string_view name) {
  for (const IdentificationResult& m : result.methods) {
    if (m.method == name) return &m;
  }
  return nullptr;
}

std::string with_unit(double value, Unit unit) {
  if (!std::isfinite(value)) return "-";
  return unit == Unit::dimensionless ? format_value(value)
                                     : fmt::format("{} {}", format_value(value), symbol(unit));
}

std::string interval(const ParameterEstimate& e) {
  return e.ci_low && e.ci_high ? report::format_interval(*e.ci_low, *e.ci_high) : "none";
}

std::optional<double> truth_of(const StudyResult& result, const ParameterEstimate& e) {
  for (const TrueValue& t : result.truth) {
    if (t.parameter == e.parameter &&
        (t.muscle == e.muscle || (e.muscle == "subject" && t.parameter == "emg_delay")))
      return t.value;
  }
  return std::nullopt;
}

std::string spelled(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

Table torque_table(const StudyResult& result, const IdentificationResult& method) {
  Table table{"parameters_torque",
              "Identified parameters (method torque)",
              "All muscles and both branches at once against the joint torque. Interval: 95 %, for "
              "correlated residuals. Prior: the literature's mean and spread.",
              {},
              {}};
  if (!result.truth.empty())
    table.caption += " Truth: green if it lies in the interval, else marked.";
  table.columns = {"muscle", "parameter", "prior", "estimate", "95 % interval", "verdict", "why"};
  if (!result.truth.empty()) table.columns.insert(table.columns.begin() + 5, "truth");
  for (const ParameterEstimate& e : method.estimates) {
    std::vector<Cell> row{{e.muscle},
                          {spelled(e.parameter)},
                          {e.prior_mean ? fmt::format("{} ± {}", with_unit(*e.prior_mean, e.unit),
                                                      format_value(*e.prior_sd, 2))
                                        : "-"},
                          {with_unit(e.estimate, e.unit)},
                          {interval(e)},
                          {spelled(std::string(identification::name(e.verdict))), badge(e.verdict)},
                          {e.reason}};
    if (!result.truth.empty()) {
      const auto truth = truth_of(result, e);
      const bool inside = truth && e.ci_low && *truth >= *e.ci_low && *truth <= *e.ci_high;
      row.insert(row.begin() + 5,
                 Cell{truth ? with_unit(*truth, e.unit) : "-", !truth || !e.ci_low ? Badge::none
                                                               : inside            ? Badge::good
                                                                                   : Badge::weak});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// The source paper's table I or II.
Table paper_table(const IdentificationResult& method, bool shortening) {
  Table table{shortening ? "table_1_shortening" : "table_2_lengthening",
              shortening ? "Table I: parameters from shortening (method paper)"
                         : "Table II: parameters from lengthening (method paper)",
              "Each muscle fitted apart to the force that force sharing assigned to it, plain "
              "Gauss-Newton, as published; intervals and verdicts are ours.",
              {},
              {}};
  table.columns = {"muscle", "parameter", "initial", "estimate", "95 % interval", "verdict", "why"};
  for (const ParameterEstimate& e : method.estimates) {
    if ((e.fit_case == "shortening") != shortening) continue;
    table.rows.push_back({{e.muscle},
                          {spelled(e.parameter)},
                          {with_unit(e.initial, e.unit)},
                          {with_unit(e.estimate, e.unit)},
                          {interval(e)},
                          {spelled(std::string(identification::name(e.verdict))), badge(e.verdict)},
                          {e.reason}});
  }
  return table;
}

/// The literature's numbers with those of the truth in their place; empty without a truth.
std::optional<muscle::HillParameters<double>> true_muscle(
    const StudyResult& result, const identification::MuscleSetup& setup) {
  std::optional<muscle::HillParameters<double>> muscle;
  for (const TrueValue& t : result.truth) {
    if (t.muscle != setup.name) continue;
    for (const muscle::HillField& field : muscle::kHillFields) {
      if (field.name != t.parameter) continue;
      if (!muscle) muscle = setup.start;
      (*muscle).*field.member = t.value;
    }
  }
  return muscle;
}

/// The paper's figure 2 for one muscle: force-length and force-velocity, literature and identified.
Figure curves(const StudyResult& result, const IdentificationResult& method, std::size_t m) {
  const auto& setup = result.data.muscles[m];
  const auto& found = method.muscles[m];
  Figure figure{
      "curves_" + setup.name,
      fmt::format("{}: force-length and force-velocity relations", setup.name),
      "Grey dotted: literature; orange dashed: identified; thin black: the truth of a virtual "
      "recording. The shaded range is what the recording visited.",
      {},
      2};
  double low = 1e9;
  double high = -1e9;
  double fastest = 0.05;
  for (const auto& trial : result.data.trials) {
    const auto c = static_cast<Eigen::Index>(m);
    low = std::min(low, trial.length_m.col(c).minCoeff() - setup.start.tendon_slack_length_m);
    high = std::max(high, trial.length_m.col(c).maxCoeff() - setup.start.tendon_slack_length_m);
    fastest = std::max(fastest, trial.velocity_mps.col(c).cwiseAbs().maxCoeff());
  }
  const auto sample = [](double from, double to, auto f) {
    std::pair<std::vector<double>, std::vector<double>> xy;
    for (int i = 0; i <= 160; ++i) {
      const double x = from + (to - from) * i / 160.0;
      xy.first.push_back(x);
      xy.second.push_back(f(x));
    }
    return xy;
  };
  const double l0 = setup.start.optimal_fiber_length_m;
  const double span = 1.6 * setup.start.force_length_width_m;
  Panel length{"", {"fiber length", "m", {}, {}, {}}, {"force / (a F_max)", "", {}, {}, {}}, {}};
  length.series.push_back({"visited", {low, high}, {0.0, 0.0}, Role::band, {}, {1.0, 1.0}});
  const auto [lx, ly] = sample(l0 - span, l0 + span, [&](double x) {
    return muscle::force_length(x, setup.start.optimal_fiber_length_m,
                                setup.start.force_length_width_m);
  });
  length.series.push_back({"literature", lx, ly, Role::literature, {}, {}});
  const auto [ix, iy] = sample(l0 - span, l0 + span, [&](double x) {
    return muscle::force_length(x, found.optimal_fiber_length_m, found.force_length_width_m);
  });
  length.series.push_back({"identified", ix, iy, Role::identified, {}, {}});
  const auto truth = true_muscle(result, setup);
  if (truth) {
    const auto [tx, ty] = sample(l0 - span, l0 + span, [&](double x) {
      return muscle::force_length(x, truth->optimal_fiber_length_m, truth->force_length_width_m);
    });
    length.series.push_back({"truth", tx, ty, Role::truth, {}, {}});
  }
  const double v = setup.start.max_shortening_speed_mps;
  Panel velocity{"",
                 {"fiber velocity (lengthening positive)", "m/s", {}, {}, {}},
                 {"force / isometric force", "", {}, {}, {}},
                 {}};
  double highest = std::max(setup.start.eccentric_plateau, found.eccentric_plateau);
  if (truth) highest = std::max(highest, truth->eccentric_plateau);
  velocity.series.push_back(
      {"visited", {-fastest, fastest}, {0.0, 0.0}, Role::band, {}, {highest, highest}});
  const auto [vx, vy] = sample(
      -v, v, [&](double x) { return muscle::force_velocity(x, setup.start.velocity_shape()); });
  velocity.series.push_back({"literature", vx, vy, Role::literature, {}, {}});
  const auto [wx, wy] =
      sample(-v, v, [&](double x) { return muscle::force_velocity(x, found.velocity_shape()); });
  velocity.series.push_back({"identified", wx, wy, Role::identified, {}, {}});
  if (truth) {
    const auto [tx, ty] =
        sample(-v, v, [&](double x) { return muscle::force_velocity(x, truth->velocity_shape()); });
    velocity.series.push_back({"truth", tx, ty, Role::truth, {}, {}});
  }
  figure.panels = {length, velocity};
  return figure;
}

/// The paper's figure 6: EMG raw, rectified, filtered, of one trial.
Figure emg_figure(const TrialResult& trial) {
  Figure figure{"emg_" + trial.spec.name,
                fmt::format("EMG of trial {}: raw, rectified, filtered", trial.spec.name),
                "Millivolts; the orange line is the envelope.",
                {},
                2};
  const TimeSeries& raw = trial.emg->raw;
  const TimeSeries& rectified = trial.emg->rectified;
  const TimeSeries& envelope = trial.emg->envelope;
  for (std::size_t c = 0; c < raw.channels().size(); ++c) {
    const auto column = static_cast<Eigen::Index>(c);
    const std::vector<double> t = to_vector(raw.time_s());
    Panel left{raw.channels()[c].name, {"time", "s", {}, {}, {}}, {"EMG", "mV", {}, {}, {}}, {}};
    left.series.push_back({"raw, mean removed",
                           t,
                           to_vector(1e3 * raw.values().col(column)),
                           Role::reference,
                           {},
                           {}});
    Panel right{
        raw.channels()[c].name, {"time", "s", {}, {}, {}}, {"rectified EMG", "mV", {}, {}, {}}, {}};
    right.series.push_back(
        {"rectified", t, to_vector(1e3 * rectified.values().col(column)), Role::raw, {}, {}});
    right.series.push_back(
        {"envelope", t, to_vector(1e3 * envelope.values().col(column)), Role::identified, {}, {}});
    figure.panels.push_back(left);
    figure.panels.push_back(right);
  }
  return figure;
}

/// The paper's figures 8-10: force of every muscle over one trial.
Figure force_figure(const StudyResult& result,
                    const identification::TrialData& data,
                    const IdentificationResult& method) {
  const auto fit = std::find_if(method.trials.begin(), method.trials.end(),
                                [&](const auto& t) { return t.trial == data.name; });
  Figure figure{
      fmt::format("forces_{}_{}", method.method, data.name),
      fmt::format("Muscle forces in trial {} (method {})", data.name, method.method),
      "Blue: force that force sharing assigns (no co-contraction). Grey dotted: literature's "
      "parameters with the measured EMG. Orange dashed: identified parameters.",
      {},
      2};
  const std::vector<double> t = to_vector(data.time_s);
  for (std::size_t m = 0; m < result.data.muscles.size(); ++m) {
    const auto c = static_cast<Eigen::Index>(m);
    const Eigen::VectorXd error = fit->force_fit_n.col(c) - data.force_n.col(c);
    const bool finite = error.allFinite();
    Panel panel{
        finite
            ? fmt::format("{}: identified against shared {:.0f} N rms", result.data.muscles[m].name,
                          std::sqrt(error.squaredNorm() / static_cast<double>(error.size())))
            : result.data.muscles[m].name,
        {"time", "s", {}, {}, {}},
        {"force", "N", {}, {}, {}},
        {}};
    panel.series.push_back({"shared", t, to_vector(data.force_n.col(c)), Role::reference, {}, {}});
    panel.series.push_back(
        {"literature", t, to_vector(fit->literature_force_n.col(c)), Role::literature, {}, {}});
    if (finite)
      panel.series.push_back(
          {"identified", t, to_vector(fit->force_fit_n.col(c)), Role::identified, {}, {}});
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

std::vector<std::string> assumptions(const StudyResult& result) {
  std::vector<std::string> list = result.study.subject.notes;
  list.push_back(result.study.identify.elastic_tendon
                     ? "Tendons stretch by the strain that the model gives them, quasi-statically."
                     : "The tendon is taken as rigid: fiber length = musculotendon length - tendon "
                       "slack length. Optimal fiber length and tendon slack length then act only "
                       "together; the slack length is held.");
  list.push_back(fmt::format(
      "{}; the muscles are effective ones that stand for all heads lumped into them.",
      result.study.identify.model_muscles
          ? "Pennation and passive muscle force are those of the model"
          : "Pennation and passive muscle force are neglected, as in the source paper"));
  list.push_back("v_max is held at its starting value; an error in it goes into V_sh.");
  list.push_back(
      "At low activation the optimal length is longer than at full activation (about 15 %); the l0 "
      "given here belongs to the activations of this recording.");
  for (const auto& muscle : result.study.muscles) {
    if (muscle.same_as)
      list.push_back(
          fmt::format("{} has no electrode: it is taken to act as {} does. Their strengths can "
                      "hardly be told apart.",
                      muscle.name, *muscle.same_as));
  }
  if (!result.study.subject.mass_kg)
    list.push_back("Body mass is not given: 73 kg is assumed for the built-in arm's inertia.");
  std::string white;
  for (const signals::WhiteningFilter& filter : result.whitening) {
    white += filter.reason.empty()
                 ? fmt::format("{} {:.0f} to {:.0f} Hz, ", filter.channel,
                               filter.bandwidth_before_hz, filter.bandwidth_after_hz)
                 : fmt::format("{} not, for {}, ", filter.channel, filter.reason);
  }
  if (!white.empty()) {
    white.resize(white.size() - 2);
    list.push_back(
        fmt::format("EMG whitened before it is rectified; statistical bandwidth: {}.", white));
  }
  list.push_back(
      fmt::format("EMG: high-pass {} Hz, rectified, low-pass {} Hz{}; largest {} s mean over the "
                  "study counts as 1.",
                  result.study.emg.highpass_hz, result.study.emg.lowpass_hz,
                  result.study.emg.as_published ? " designed for one pass, as published"
                                                : " (-3 dB of both passes)",
                  result.study.emg.normalise_window_s));
  if (result.study.emg.has_mvc) {
    const EmgSpec& emg = result.study.emg;
    list.push_back(
        emg.mvc_effort_sd > 0.0 || emg.mvc_effort < 1.0
            ? fmt::format(
                  "F_max is what a muscle could exert if all of it were active: the maximal "
                  "contractions are taken to reach {:.0f} +- {:.0f} % of that.",
                  100.0 * emg.mvc_effort, 100.0 * emg.mvc_effort_sd)
            : std::string("F_max is the force at the greatest effort that was recorded. Untrained "
                          "people reach some 80 to 100 % of what their muscles could exert; "
                          "[emg] mvc_effort accounts for that."));
  }
  for (const std::string& text : result.model.unsupported) list.push_back("Model: " + text + ".");
  return list;
}

std::string headline(const StudyResult& result) {
  const IdentificationResult* torque = method_of(result, "torque");
  if (torque == nullptr)
    return "Parameters by the source paper's method, each with an interval and a verdict.";
  std::vector<std::string> sure;
  int total = 0;
  for (const ParameterEstimate& e : torque->estimates) {
    if (identification::is_nuisance(e)) continue;
    ++total;
    if (e.verdict == Verdict::identified) sure.push_back(e.muscle + " " + spelled(e.parameter));
  }
  std::string text =
      sure.empty()
          ? fmt::format("This recording identifies none of {} parameters with certainty.", total)
          : fmt::format("This recording identifies {} of {} parameters: {}.", sure.size(), total,
                        fmt::join(sure, ", "));
  if (!result.folds.empty()) {
    double r2 = 0.0;
    double base = 0.0;
    for (const auto& f : result.folds) {
      r2 += f.identified.r2 / static_cast<double>(result.folds.size());
      base += f.literature.r2 / static_cast<double>(result.folds.size());
    }
    text += fmt::format(
        " Torque of trials left out of the fit is predicted with R2 = {:.2f} on average "
        "(literature's parameters with a best gain: {:.2f}).",
        r2, base);
  }
  return text;
}

}  // namespace

report::Report study_report(const StudyResult& result, const Provenance& provenance) {
  report::Report report;
  report.title = fmt::format("Muscle parameters of {}", result.study.subject.name);
  std::vector<std::string> joints;
  for (const std::string& name : study_coordinates(result.study.model))
    joints.push_back(spelled(name));
  report.subtitle =
      fmt::format("{} trials; joint coordinate{} {}; model {}", result.trials.size(),
                  joints.size() > 1 ? "s" : "", fmt::join(joints, ", "), result.model.name);
  report.headline = headline(result);
  if (has_motion_page(result))
    report.links.push_back({"The model moving through every trial, in the browser", kMotionPage});
  report.gates = quality_gates(result);
  const IdentificationResult* torque = method_of(result, "torque");
  const IdentificationResult* paper = method_of(result, "paper");

  report.sections.push_back(recordings_section(result));
  if (torque != nullptr) {
    Section section{"parameters", "Parameters", {}, {}, {}, {}};
    section.paragraphs.push_back(
        fmt::format("{} samples, worth {:.0f} independent ones; torque noise {:.2f} N m; EMG noise "
                    "{} of the torque of each channel; EMG delay {:.0f} ms.",
                    torque->samples_used, torque->effective_samples, torque->torque_sd_nm,
                    torque->emg_cv < 0.005 ? std::string("too small to be told from it, below 1 %")
                                           : fmt::format("{:.0f} %", 100.0 * torque->emg_cv),
                    1000.0 * torque->delay_s));
    if (!torque->collinear.empty())
      section.paragraphs.push_back(
          fmt::format("Hardly told apart: {}.", fmt::join(torque->collinear, "; ")));
    section.tables.push_back(torque_table(result, *torque));
    for (std::size_t m = 0; m < result.data.muscles.size(); ++m)
      section.figures.push_back(curves(result, *torque, m));
    report.sections.push_back(std::move(section));
  }
  for (Section& section : validation_sections(result))
    report.sections.push_back(std::move(section));
  if (result.next) report.sections.push_back(next_recording_section(*result.next));
  if (paper != nullptr) {
    Section section{"paper", "The source paper's method beside it", {}, {}, {}, {}};
    section.paragraphs.push_back(
        "Published in 2006: every muscle alone, shortening and lengthening apart, against forces "
        "that an optimization assigned. Those forces know nothing of co-contraction or of the "
        "person's own "
        "strength, so that its numbers often leave physiology; the verdicts say where.");
    section.tables = {paper_table(*paper, true), paper_table(*paper, false)};
    report.sections.push_back(std::move(section));
  }
  Section forces{"forces", "Muscle forces", {}, {}, {}, {}};
  std::vector<const identification::TrialData*> shown;
  for (const auto& data : result.data.trials) shown.push_back(&data);
  // Those with the most movement first; all are in the trials' folders.
  std::stable_sort(shown.begin(), shown.end(), [](const auto* a, const auto* b) {
    const auto range = [](const identification::TrialData* d) {
      return (d->length_m.colwise().maxCoeff() - d->length_m.colwise().minCoeff()).maxCoeff();
    };
    return std::lround(100.0 * range(a)) > std::lround(100.0 * range(b));
  });
  if (shown.size() > 6) shown.resize(6);
  if (torque != nullptr) {
    for (const auto* data : shown) forces.figures.push_back(force_figure(result, *data, *torque));
  }
  if (paper != nullptr && !result.data.trials.empty())
    forces.figures.push_back(force_figure(result, *shown.front(), *paper));
  report.sections.push_back(std::move(forces));
  const auto task =
      std::find_if(result.trials.begin(), result.trials.end(),
                   [](const TrialResult& t) { return t.emg && t.spec.use == Use::calibration; });
  if (task != result.trials.end())
    report.sections.push_back({"emg", "EMG", {}, {}, {}, {emg_figure(*task)}});
  if (!result.informed.empty() || result.force_loop)
    report.sections.push_back(informed_section(result));
  if (!result.phases.empty()) report.sections.push_back(phases_section(result));
  Section trials{"trials", "Trials", {}, {}, {trials_table(result)}, {}};
  std::vector<std::string> notes;
  for (const TrialResult& t : result.trials) {
    for (const std::string& note : t.notes)
      notes.push_back(fmt::format("{}: {}", t.spec.name, note));
  }
  if (notes.size() > 12) {
    notes.resize(12);
    notes.push_back("More remarks stand in run.json.");
  }
  trials.paragraphs = notes;
  report.sections.push_back(std::move(trials));

  report.assumptions = assumptions(result);
  report.provenance.push_back(
      {"program", fmt::format("{} {}", provenance.program, provenance.version)});
  report.provenance.push_back({"command", provenance.command});
  for (const InputFile& file : provenance.inputs)
    report.provenance.push_back({file.path, "sha256 " + file.sha256});
  for (const StageTime& t : result.times)
    report.provenance.push_back({"time: " + t.stage, fmt::format("{:.2f} s", t.seconds)});
  report.provenance.push_back({"options", provenance.options_json});
  return report;
}

}  // namespace myoid::pipeline
