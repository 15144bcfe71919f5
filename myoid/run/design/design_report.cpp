#include "myoid/run/design/design_report.h"

#include <fmt/format.h>

#include "myoid/run/design/verdict_badge.h"

namespace myoid::run {
namespace {

using fit::ParameterEstimate;
using fit::Verdict;
using page::Badge;
using page::Cell;

std::string half_width_text(const ParameterEstimate& e) {
  return fmt::format("+- {:.3g} {}", relative_half_width(e), e.parameter == "emg_delay" ? "ms" : "%");
}

Badge plan_badge(Verdict verdict) {
  const Badge badge = verdict_badge(verdict);
  return badge == Badge::good || badge == Badge::weak || badge == Badge::repeat ? badge : Badge::info;
}

page::Table plan_table(const DesignStudyResult& design) {
  page::Table table{
      "next_recording",
      "Movements that would tell most",
      fmt::format("Chosen from {} movements{}{}; {} were beyond the strength that is certain. After each "
                  "movement and all before it: the median over the parameters of the half 95 % "
                  "interval that may be expected, and how many would be identified.",
                  design.catalogue_size, design.range.empty() ? "" : " of ", design.range, design.too_hard),
      {"", "movement", "duration", "rest before", "median interval", "identified"},
      {}};
  table.rows.push_back({{"0"},
                        {"what is known beforehand"},
                        {"-"},
                        {"-"},
                        {fmt::format("+- {:.0f} %", median_half_width(design.beforehand))},
                        {fmt::format("{} of {}", identified_count(design.beforehand), design.beforehand.size())}});
  for (std::size_t i = 0; i < design.plan.size(); ++i) {
    const PlannedMovement& m = design.plan[i];
    table.rows.push_back({{fmt::format("{}", i + 1)},
                          {m.movement.description()},
                          {fmt::format("{:.0f} s", m.movement.duration_s)},
                          {fmt::format("{:.0f} s", m.rest_before_s)},
                          {fmt::format("+- {:.0f} %", median_half_width(m.expected))},
                          {fmt::format("{} of {}", identified_count(m.expected), m.expected.size())}});
  }
  return table;
}

page::Table targets_table(const DesignStudyResult& design) {
  page::Table table{
      "next_recording_targets",
      "What they would tell",
      "Half 95 % interval now, after each of the movements above and then, after all of them, and the verdict that may "
      "then be expected.",
      {"muscle", "parameter", "now"},
      {}};
  for (std::size_t i = 1; i < design.plan.size(); ++i) table.columns.push_back(fmt::format("after {}", i));
  table.columns.insert(table.columns.end(), {"then", "verdict then"});
  for (std::size_t t = 0; t < design.beforehand.size(); ++t) {
    const ParameterEstimate& before = design.beforehand[t];
    std::vector<Cell> row{{before.muscle}, {before.parameter}, {half_width_text(before)}};
    for (const PlannedMovement& m : design.plan) row.push_back({half_width_text(m.expected[t])});
    const Verdict then = design.plan.back().expected[t].verdict;
    row.push_back({std::string(fit::name(then)), plan_badge(then)});
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

page::Section next_recording_section(const DesignStudyResult& design) {
  page::Section section{"next", "What to record next", {}, {}, {}, {}};
  if (design.plan.empty()) {
    section.paragraphs.push_back(
        "No movement of the catalogue is within the strength that this recording makes certain, or none tells anything "
        "new: record the greatest efforts (MVC) first.");
    return section;
  }
  section.paragraphs.push_back(
      "Expected with the noise and the results of this recording. Errors of the model itself are not in these "
      "expectations. Isometric efforts need a measured torque (a dynamometer, or a load cell at a known distance). "
      "`myoid design` asks for other targets, masses and devices.");
  section.tables.push_back(plan_table(design));
  section.tables.push_back(targets_table(design));
  return section;
}

}  // namespace myoid::run
