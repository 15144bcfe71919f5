#include "myoid/results/torque_report.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/fit/intervals/verdict_rules.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/page/tables.h"
#include "myoid/results/prediction_files.h"
#include "myoid/run/prediction_gates.h"

namespace myoid::results {
namespace {

using page::Badge;
using page::Cell;
using page::Figure;
using page::format_value;
using page::Panel;
using page::Role;
using page::Section;
using page::Table;
using page::to_vector;

/// Returns predicted values as a curve, with a gap at the beginning, where the recording lacks the
/// earlier EMG that the delay needs.
std::vector<double> after_delay(const Eigen::VectorXd& predicted, const Eigen::VectorXd& time_s, double delay_s) {
  std::vector<double> curve = to_vector(predicted);
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (time_s[static_cast<Eigen::Index>(i)] < time_s[0] + delay_s) curve[i] = kNan;
  }
  return curve;
}

/// Returns the name of the trial, and of the joint (or the muscle, of method `force`) if there are several.
std::string title_of(const run::StudyResult& result, const std::string& trial, const std::string& joint) {
  const bool several =
      !result.source.study.model.more_coordinates.empty() ||
      std::ranges::any_of(result.folds, [&](const fit::Fold& f) { return f.joint != result.folds.front().joint; });
  return several ? fmt::format("{}, {}", trial, joint) : trial;
}

/// Draws measured, literature's and identified torque, and the band about the last.
Panel torque_panel(std::string title,
                   const Eigen::VectorXd& time_s,
                   const Eigen::VectorXd& measured_nm,
                   const Eigen::VectorXd& literature_nm,
                   const Eigen::VectorXd& identified_nm,
                   const Eigen::VectorXd& identified_sd_nm,
                   double delay_s) {
  Panel panel = page::time_panel(std::move(title), "torque", "N m");
  const std::vector<double> t = to_vector(time_s);
  if (const Band band = prediction_band(identified_nm, identified_sd_nm); band.low.size() > 0)
    panel.series.push_back({"95 % band",
                            t,
                            after_delay(band.low, time_s, delay_s),
                            Role::band,
                            {},
                            after_delay(band.high, time_s, delay_s)});
  panel.series.push_back({"inverse dynamics", t, to_vector(measured_nm), Role::reference});
  panel.series.push_back({"literature", t, after_delay(literature_nm, time_s, delay_s), Role::literature});
  panel.series.push_back({"identified", t, after_delay(identified_nm, time_s, delay_s), Role::identified});
  return panel;
}

Figure folds_figure(const run::StudyResult& result, double delay_s) {
  const std::string_view left_out = choice_name(result.source.study.identify.folds);
  Figure figure{
      "torque_held_out",
      fmt::format("The {} of {}s that took no part in the fit", run::predicted_by_folds(result).name, left_out),
      fmt::format("Blue: measured. Orange dashed: muscles identified on the other {}s. Grey dotted: the "
                  "literature's with one best gain. The worst predicted come first.",
                  left_out),
      {},
      2};
  figure.in_workbench = left_out == "trial";
  figure.most_on_page = 6;
  std::vector<const fit::Fold*> folds;
  for (const fit::Fold& f : result.folds) folds.push_back(&f);
  std::ranges::stable_sort(folds, {}, [](const fit::Fold* f) { return f->identified.r2(); });
  for (const fit::Fold* f : folds) {
    figure.panels.push_back(
        torque_panel(fmt::format("{}: R2 {:.2f}", title_of(result, f->trial, f->joint), f->identified.r2()), f->time_s,
                     f->measured_nm, f->literature_nm, f->predicted_nm, f->predicted_sd_nm, delay_s));
  }
  return figure;
}

/// Returns error and R2: "1.77 (0.35)".
std::string error_and_r2(const fit::Score& score) {
  return fmt::format("{:.2f} ({:.2f})", score.rmse_nm(), score.r2());
}

/// Returns "94 %"; "-" if unknown.
std::string share_text(double share) {
  return std::isfinite(share) ? fmt::format("{:.0f} %", 100.0 * share) : std::string("-");
}

/// Returns a trial's first cells: its name, RMSE, NRMSE and R2, good above `least_r2`; NRMSE and R2 below
/// 1.5 Hz.
std::vector<Cell> score_cells(Cell name, const fit::Score& score, double least_r2, const fit::Score& band) {
  return {std::move(name),
          {fmt::format("{:.2f}", score.rmse_nm())},
          {fmt::format("{:.1f} %", 100.0 * score.nrmse_range())},
          {fmt::format("{:.3f}", score.r2()), score.r2() > least_r2 ? Badge::good : Badge::weak},
          {fmt::format("{:.1f} %", 100.0 * band.nrmse_range())},
          {fmt::format("{:.3f}", band.r2())}};
}

Table folds_table(const run::StudyResult& result) {
  const std::string_view left_out = choice_name(result.source.study.identify.folds);
  const auto [predicted, unit] = run::predicted_by_folds(result);
  Table table{
      "leave_one_trial_out",
      fmt::format("Leave-one-{}-out prediction of the {}", left_out, predicted),
      fmt::format("R2 = 1 - SSE/SST, negative when worse than the {}'s own mean. ", left_out) +
          "NRMSE is RMSE over the range. The prediction is that of a fit without this part (fold_parameters.csv); in "
          "band: share of the samples within the prediction's 95 % band. Below 1.5 Hz both are compared without faster "
          "changes, which in the prediction are mostly noise of the EMG. Lag: positive if the prediction comes late. "
          "Baselines, RMSE and R2 in brackets: the literature's parameters with the one gain that fits the others "
          "best; a regression on EMG times moment arm; the others' mean.",
      {std::string(left_out), fmt::format("RMSE [{}]", unit), "NRMSE", "R2", "NRMSE below 1.5 Hz", "R2 below 1.5 Hz",
       "VAF", "in band", "lag [ms]", "literature x gain", "regression", "constant"}};
  const std::vector<run::OutlyingFold> outlying = run::outlying_folds(result.folds);
  for (const fit::Fold& f : result.folds) {
    const bool stands_out = std::ranges::any_of(
        outlying, [&](const run::OutlyingFold& o) { return o.trial == f.trial && o.joint == f.joint; });
    const std::string title = title_of(result, f.trial, f.joint);
    std::vector<Cell> row =
        score_cells(stands_out ? Cell{title, Badge::bad, "its error stands out from the others' errors"} : Cell{title},
                    f.identified, std::max(fit::kVerdictRules.least_r2, f.literature.r2()), f.band);
    row.insert(row.end(), {{fmt::format("{:.3f}", f.identified.vaf())},
                           {share_text(f.covered)},
                           {fmt::format("{:.0f}", 1000.0 * f.lag_s)},
                           {error_and_r2(f.literature)},
                           {error_and_r2(f.regression)},
                           {fmt::format("{:.2f}", f.constant.rmse_nm())}});
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table held_back_table(const run::StudyResult& result, const fit::IdentificationResult& method) {
  Table table{"validation_trials",
              "Trials held back for validation",
              "Joint torque predicted with the muscles identified on the calibration trials.",
              {"trial", "RMSE [N m]", "NRMSE", "R2", "NRMSE below 1.5 Hz", "R2 below 1.5 Hz", "in band"}};
  for (const fit::TrialFit& t : method.trials) {
    if (t.calibration) continue;
    table.rows.push_back(
        score_cells({title_of(result, t.trial, t.joint)}, t.score, fit::kVerdictRules.least_r2, t.band));
    table.rows.back().push_back({share_text(fit::covered_share(t.torque_nm, t.torque_fit_nm, t.torque_sd_nm))});
  }
  return table;
}

Figure held_back_figure(const run::StudyResult& result, const fit::IdentificationResult& method) {
  Figure figure{"torque_validation",
                "Joint torque predicted for the trials held back",
                "Blue: inverse dynamics. Orange dashed: muscles identified on the calibration trials. Grey dotted: "
                "literature's muscles.",
                {},
                2};
  figure.in_workbench = true;
  figure.most_on_page = 6;
  for (const fit::TrialFit& t : method.trials) {
    if (t.calibration) continue;
    figure.panels.push_back(torque_panel(fmt::format("{}: R2 {:.2f}", title_of(result, t.trial, t.joint), t.score.r2()),
                                         t.time_s, t.torque_nm, t.literature_torque_nm, t.torque_fit_nm, t.torque_sd_nm,
                                         method.delay_s));
  }
  return figure;
}

/// Returns the errors of fiber lengths, a row for each muscle of each trial that has measured fascicles; without rows
/// if no trial has.
template <typename Scored>
Table fibers_table(std::string id, std::string_view of, const std::vector<Scored>& scored) {
  Table table{.id = std::move(id),
              .title = fmt::format("Fiber lengths predicted for {} beside the measured fascicles", of),
              .columns = {"trial", "muscle", "RMS [mm]"}};
  for (const Scored& one : scored)
    for (const fit::FiberScore& fiber : one.fibers)
      table.rows.push_back(page::text_row({one.trial, fiber.muscle, fmt::format("{:.2f}", 1e3 * fiber.rms_m())}));
  return table;
}

/// Returns the section on measured fascicles; empty if no trial has any.
std::optional<Section> fibers_section(const run::StudyResult& result, const fit::IdentificationResult* torque) {
  Section section{.id = "fascicles", .heading = "Fiber lengths beside measured fascicles"};
  section.tables = {fibers_table("fibers_held_out", "what was left out", result.folds),
                    fibers_table("fibers", "all trials by the whole fit",
                                 torque != nullptr ? torque->trials : std::vector<fit::TrialFit>())};
  std::erase_if(section.tables, [](const Table& table) { return table.rows.empty(); });
  return section.tables.empty() ? std::nullopt : std::optional(std::move(section));
}

std::string range_text(const Eigen::VectorXd& values, int decimals) {
  return fmt::format("{:.{}f} to {:.{}f}", values.minCoeff(), decimals, values.maxCoeff(), decimals);
}

}  // namespace

std::vector<Section> validation_sections(const run::StudyResult& result) {
  const fit::IdentificationResult* torque = run::torque_of(result.fit);
  std::vector<Section> sections;
  if (!result.folds.empty()) {
    sections.push_back(
        {.id = "validation",
         .heading = fmt::format("Validation on {}s left out", choice_name(result.source.study.identify.folds)),
         .tables = {folds_table(result)},
         .figures = {folds_figure(result, torque != nullptr ? torque->delay_s : 0.0)}});
  }
  if (torque != nullptr && std::ranges::any_of(torque->trials, [](const auto& t) { return !t.calibration; })) {
    sections.push_back({.id = "validation_trials",
                        .heading = "Validation on trials held back",
                        .tables = {held_back_table(result, *torque)},
                        .figures = {held_back_figure(result, *torque)}});
  }
  if (auto fibers = fibers_section(result, torque)) sections.push_back(std::move(*fibers));
  return sections;
}

Table trials_table(const run::StudyResult& result) {
  Table table{"trials",
              "Trials",
              "What was recorded and how it went. Ranges of several joints in the order of the study's coordinates.",
              {"trial", "use", "duration", "held mass", "joint range", "torque range", "status"}};
  const bool clocks =
      std::ranges::any_of(result.trials, [](const run::TrialResult& t) { return t.input.emg_clock.has_value(); });
  if (clocks) table.columns.insert(table.columns.end() - 1, "EMG's clock moved by");
  for (const run::TrialResult& t : result.trials) {
    std::vector<Cell> row{{t.spec.name}, {std::string(choice_name(t.spec.use))}};
    if (t.has_motion()) {
      std::vector<std::string> angles, torques;
      const std::vector<std::string> coordinates = study::study_coordinates(result.source.study.model);
      for (std::size_t j = 0; j < coordinates.size(); ++j) {
        const auto angle = t.motion.joints.q.find(coordinates[j]);
        if (angle) angles.push_back(range_text(t.motion.joints.q.values().col(*angle) / kDegree, 0));
        if (!t.forces.muscle_torque.empty())
          torques.push_back(range_text(t.forces.muscle_torque.values().col(static_cast<Eigen::Index>(j)), 1));
      }
      const auto& clock = t.motion.joints.q.time_s();
      row.insert(row.end(), {{fmt::format("{:.1f} s", clock[clock.size() - 1] - clock[0])},
                             {fmt::format("{} kg", format_value(t.spec.held_mass_kg.value_or(0.0)))},
                             {angles.empty() ? "-" : fmt::format("{} deg", fmt::join(angles, "; "))},
                             {torques.empty() ? "-" : fmt::format("{} N m", fmt::join(torques, "; "))}});
    } else {
      row.resize(row.size() + 4, {"-"});
    }
    if (clocks) {
      row.push_back(t.input.emg_clock
                        ? Cell{recording::to_string(t.input.emg_clock->clock), Badge::none, t.input.emg_clock->source}
                        : Cell{"-"});
    }
    row.push_back(t.failure().empty() ? Cell{"ok", Badge::good} : Cell{"failed", Badge::bad, t.failure()});
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace myoid::results
