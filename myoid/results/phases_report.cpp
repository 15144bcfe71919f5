#include "myoid/results/phases_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/page/tables.h"

namespace myoid::results {
namespace {

using page::Badge;
using page::Role;
using page::to_vector;

std::string percent_of(const std::optional<double>& x) { return x ? fmt::format("{:.0f} %", 100.0 * *x) : "-"; }

Badge badge(study::PhaseKind kind) {
  if (kind == study::PhaseKind::regular) return Badge::good;
  return kind == study::PhaseKind::rest || kind == study::PhaseKind::isometric ? Badge::info : Badge::weak;
}

/// Draws measured and predicted torque over the excluded phases.
page::Panel torque_panel(const run::StudyResult& result, const study::TrialPhases& trial) {
  page::Panel panel = page::time_panel(trial.trial, "torque", "N m");
  const auto& trials = result.fit_input.data.trials;
  const auto data = std::ranges::find(trials, trial.trial, &fit::TrialData::name);
  if (data == trials.end()) return panel;
  const double low = data->torque_nm.minCoeff();
  const double high = data->torque_nm.maxCoeff();
  for (const study::Phase& phase : trial.phases) {
    if (!phase.excluded) continue;
    panel.series.push_back({.name = std::string(choice_name(phase.kind)) + ", not fitted",
                            .x = {phase.begin_s, phase.end_s},
                            .y = {low, low},
                            .role = Role::band,
                            .y_upper = {high, high}});
  }
  panel.series.push_back({"inverse dynamics", to_vector(data->time_s), to_vector(data->torque_nm), Role::reference});
  const fit::IdentificationResult* torque = run::torque_of(result.fit);
  if (torque == nullptr) return panel;
  for (const fit::TrialFit& fit : torque->trials) {
    if (fit.trial == trial.trial)
      panel.series.push_back(
          {"identified muscles", to_vector(fit.time_s), to_vector(fit.torque_fit_nm), Role::identified});
  }
  return panel;
}

}  // namespace

page::Section phases_section(const run::StudyResult& result) {
  page::Section section{.id = "phases", .heading = "Phases of the trials"};
  page::Table table{
      .id = "phases",
      .title = "Rest, isometric contraction, fatigue",
      .caption =
          "Fatigue: torque per EMG and the EMG's median frequency fall together; both relative to the fresh muscles.",
      .columns = {"trial", "phase", "from [s]", "to [s]", "torque per EMG", "median frequency", "fitted", "reason"}};
  page::Figure figure{.id = "phases_torque",
                      .title = "Trials of which a phase was left out",
                      .caption = "Shaded: not fitted.",
                      .columns = 1};
  int whole = 0;
  for (const study::TrialPhases& trial : result.fit_input.phases) {
    if (trial.phases.size() == 1 && trial.phases.front().kind == study::PhaseKind::regular) {
      ++whole;
      continue;
    }
    bool left_out = false;
    for (const study::Phase& phase : trial.phases) {
      left_out = left_out || phase.excluded;
      table.rows.push_back({{trial.trial},
                            {std::string(choice_name(phase.kind)), badge(phase.kind), phase.reason},
                            {fmt::format("{:.1f}", phase.begin_s)},
                            {fmt::format("{:.1f}", phase.end_s)},
                            {percent_of(phase.gain)},
                            {percent_of(phase.frequency)},
                            {phase.excluded ? "no" : "yes"},
                            {phase.reason}});
    }
    if (left_out) figure.panels.push_back(torque_panel(result, trial));
  }
  section.paragraphs.push_back(fmt::format("{} of {} trials are one regular phase from beginning to end.", whole,
                                           result.fit_input.phases.size()));
  if (!table.rows.empty()) section.tables.push_back(std::move(table));
  if (!figure.panels.empty()) section.figures.push_back(std::move(figure));
  return section;
}

page::Section informed_section(const run::StudyResult& result) {
  page::Section section{.id = "informed", .heading = "Back into the body"};
  if (!result.fit.informed.empty()) {
    page::Table table{.id = "informed_forces",
                      .title = "Forces with the identified muscles, informed by the EMG",
                      .caption =
                          "What the muscles found must do so that the torque is balanced, as near to the EMG as they "
                          "can; antagonists may act together. The forces themselves are in each trial's "
                          "EmgInformed_force.sto and EmgInformed_activation.sto.",
                      .columns = {"trial", "departure from the EMG (rms)", "torque no muscle carries (rms) [N m]",
                                  "frames not solved"}};
    for (const run::InformedForces& f : result.fit.informed) {
      const auto samples = static_cast<double>(f.activation.size());
      const auto reserves = static_cast<double>(std::max<Eigen::Index>(1, f.reserve_nm.size()));
      table.rows.push_back(page::text_row(
          {f.trial, fmt::format("{:.3f}", std::sqrt((f.activation - f.measured).squaredNorm() / samples)),
           fmt::format("{:.2f}", std::sqrt(f.reserve_nm.squaredNorm() / reserves)),
           fmt::format("{}", f.frames_not_solved)}));
    }
    section.tables.push_back(std::move(table));
  }
  return section;
}

}  // namespace myoid::results
