#include "myoid/results/comparison/comparison_report.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/page/muscle_names.h"
#include "myoid/page/plain_unit.h"
#include "myoid/page/tables.h"
#include "myoid/page/typeset.h"
#include "myoid/results/comparison/change_sentences.h"

namespace myoid::results {
namespace {

using fit::ParameterEstimate;
using page::PlainUnit;

page::Badge badge(Change change) {
  return change == Change::differs     ? page::Badge::info
         : change == Change::no_change ? page::Badge::good
         : change == Change::treatment ? page::Badge::none
                                       : page::Badge::weak;
}

std::string verdict(const ComparedParameter& p) {
  return p.differs_alone_only() ? fmt::format("no change shown among {} numbers", p.tested)
                                : page::spelled(name(p.change));
}

/// Returns "second (2026-03-01)".
std::string session_name(std::string_view which, const std::string& day) {
  return day.empty() ? std::string(which) : fmt::format("{} ({})", which, day);
}

std::string number_name(const ParameterEstimate& e) {
  return page::spelled(e.parameter) + branch_text(e.fit_case, " (", ")");
}

std::string owner_name(const ComparedParameter& p) { return page::spelled(page::plain_muscle_and_name(p.muscle)); }

/// Returns the number in the unit for people.
page::SessionValue shown(const ComparedValue& of, const PlainUnit& unit) {
  const auto scaled = [&](const std::optional<double>& x) { return x ? std::optional(*x * unit.per_si) : x; };
  return {of.value * unit.per_si, scaled(of.low), scaled(of.high)};
}

std::string value_text(const page::SessionValue& of) {
  const std::string value = page::format_beside(of.value, of.lower, of.upper);
  return of.lower && of.upper ? fmt::format("{} ({})", value, page::format_interval(*of.lower, *of.upper)) : value;
}

std::string p_text(const std::optional<double>& p) { return p ? fmt::format("{:.2g}", *p) : "–"; }

std::string change_in_percent(const ComparedParameter& p) {
  if (!has_scale(p)) return "-";
  const double percent = 100.0 * p.difference / std::abs(p.of_first.value);
  return (percent < 0.0 ? "" : "+") + percent_text(percent);
}

/// Draws the numbers that both sessions tell, the greatest torques first.
page::ChangeForest changes_of(const RunComparison& comparison) {
  page::ChangeForest forest{.first = session_name("first", comparison.first_date),
                            .second = session_name("second", comparison.second_date)};
  for (const bool torques : {true, false}) {
    for (const ComparedParameter* p : counted_parameters(comparison)) {
      if (!p->smallest_detectable || fit::is_voluntary(p->first.parameter) != torques) continue;
      const PlainUnit unit = page::plain_unit(p->first.unit);
      forest.rows.push_back({.owner = page::spelled(page::plain_muscle(p->muscle)),
                             .name = number_name(p->first),
                             .unit = std::string(unit.symbol),
                             .first = shown(p->of_first, unit),
                             .second = shown(p->of_second, unit),
                             .detectable = *p->smallest_detectable * unit.per_si,
                             .verdict = verdict(*p),
                             .badge = badge(p->change)});
    }
  }
  return forest;
}

page::Section method_section(const RunComparison& comparison, fit::Method of) {
  const std::string method(name(of));
  return {.id = "method_" + method,
          .heading = rests_on_measurement(of) ? "All numbers of method " + method
                                              : "Method " + method + ": shown, not compared",
          .folded = !rests_on_measurement(of),
          .tables = {compared_table(comparison, of, true)}};
}

page::Section errors_section(const RunComparison& comparison) {
  page::Table errors{.id = "trial_errors",
                     .title = "Root mean square error of the torque",
                     .columns = {"trial", "method", "first [N m]", "second [N m]"}};
  const auto cell = [](const std::optional<double>& x) { return x ? page::format_value(*x) : "-"; };
  for (const ComparedTrial& t : comparison.trials)
    errors.rows.push_back(page::text_row({t.trial, t.method, cell(t.rmse_first_nm), cell(t.rmse_second_nm)}));
  return {.id = "trials",
          .heading = "How well the trials are predicted",
          .paragraphs = sentences(comparison.remarks),
          .tables = {std::move(errors)}};
}

std::string headline(const RunComparison& comparison) {
  const std::string unlike = unlike_sentence(comparison);
  return unlike + (unlike.empty() ? "" : " ") + changes_sentence(comparison);
}

}  // namespace

page::Table compared_table(const RunComparison& comparison, fit::Method of, bool all) {
  page::Table table{
      .id = fmt::format("compared_{}", name(of)),
      .title = fmt::format("Parameters (method {})", name(of)),
      .caption =
          "Number with its 95 % interval. p alone: of this number by itself, of which one in "
          "20 is below 0.05 by chance; p (Holm): corrected for all numbers that are tested. "
          "The verdict goes by p (Holm).",
      .columns = {"muscle", "parameter", "unit", session_name("first", comparison.first_date),
                  session_name("second", comparison.second_date), "difference", "%", "p alone", "p (Holm)", "verdict"}};
  for (const ComparedParameter& p : comparison.parameters) {
    if (p.first.method != of || (!all && p.change == Change::cannot_tell)) continue;
    const PlainUnit unit = page::plain_unit(p.first.unit);
    table.rows.push_back({{owner_name(p)},
                          {number_name(p.first)},
                          {unit.symbol.empty() ? "–" : std::string(unit.symbol)},
                          {value_text(shown(p.of_first, unit))},
                          {value_text(shown(p.of_second, unit))},
                          {page::format_value(p.difference * unit.per_si)},
                          {change_in_percent(p)},
                          {p_text(p.p_alone)},
                          {p_text(p.p_value)},
                          {verdict(p), badge(p.change), change_text(p)}});
  }
  return table;
}

page::Report comparison_report(const RunComparison& comparison) {
  page::Report page{
      .title = comparison.one_recording.empty() ? "Two sessions compared" : "Two treatments of one recording",
      .subtitle = comparison.first.string() + " and " + comparison.second.string(),
      .headline = headline(comparison),
      .assumptions = {
          comparison.one_recording.empty()
              ? "The two sessions are independent; where both used the same prior, the test is cautious."
              : "Both runs share the errors of one recording: no difference is tested.",
          "A number that a session calls prior_dominated, not_identifiable or non_physical is not compared.",
          "Method paper fits forces that the program shared among the muscles: its numbers are shown, not compared.",
          "The days are those on which the results were written."}};
  page::Section both{.id = "changes", .heading = "Both sessions", .changes = changes_of(comparison)};
  if (std::string reading = reading_sentence(comparison); !reading.empty())
    both.paragraphs.push_back(std::move(reading));
  page.sections.push_back(std::move(both));
  const auto add_methods = [&](bool measured) {
    for (const fit::Method method : methods_of(comparison))
      if (rests_on_measurement(method) == measured) page.sections.push_back(method_section(comparison, method));
  };
  add_methods(true);
  page.sections.push_back(errors_section(comparison));
  add_methods(false);
  return page;
}

}  // namespace myoid::results
