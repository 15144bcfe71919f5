#include "myoid/results/parameter_tables.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/page/muscle_names.h"
#include "myoid/page/parameter_words.h"
#include "myoid/page/plain_unit.h"
#include "myoid/page/tables.h"
#include "myoid/page/typeset.h"
#include "myoid/run/design/verdict_badge.h"

namespace myoid::results {
namespace {

using fit::IdentificationResult;
using fit::ParameterEstimate;
using page::Badge;
using page::Cell;
using page::format_rounded;
using page::format_value;
using page::Table;

/// Rounds a value to the digits of its interval's ends, so that all three can be compared.
std::string value_of(const ParameterEstimate& e, double value) {
  if (!std::isfinite(value)) return "-";
  return is_undetermined(e) ? format_value(value) : page::format_beside(value, e.ci_low, e.ci_high);
}

std::string unit(const ParameterEstimate& e) {
  return e.unit == Unit::dimensionless ? "–" : std::string(symbol(e.unit));
}

std::string interval(const ParameterEstimate& e) {
  if (is_undetermined(e)) return "not determined";
  return e.ci_low && e.ci_high ? page::format_interval(*e.ci_low, *e.ci_high) : "none";
}

std::string given_interval(const ParameterEstimate& e) {
  if (is_undetermined(e) || !e.given_ci_low || !e.given_ci_high) return "-";
  return page::format_interval(*e.given_ci_low, *e.given_ci_high);
}

std::string prior(const ParameterEstimate& e) {
  if (!e.prior_mean || !e.prior_sd) return "-";
  return fmt::format("{} ± {}", format_rounded(*e.prior_mean, *e.prior_sd), format_rounded(*e.prior_sd, *e.prior_sd));
}

Cell verdict_cell(const ParameterEstimate& e) {
  return {page::spelled(fit::name(e.verdict)), run::verdict_badge(e.verdict)};
}

Cell truth_cell(const run::StudyResult& result, const ParameterEstimate& e) {
  const std::optional<double> truth = truth_of(result, e);
  if (!truth) return {"-"};
  if (!e.ci_low || !e.ci_high) return {value_of(e, *truth)};
  const bool inside = *truth >= *e.ci_low && *truth <= *e.ci_high;
  return {value_of(e, *truth), inside ? Badge::good : Badge::weak};
}

/// Describes the resting torques from passive trials, for the table of nuisances.
std::string measured_at_rest(const run::StudyResult& result) {
  std::string text;
  for (const run::RestingJoint& joint : result.resting) {
    const run::RestingTorque& torque = joint.torque;
    text += fmt::format(
        " What {} does by itself was measured ({}): {:.1f} N m at {:.0f}°, {:.1f} N m at {:.0f}°. It is part of every "
        "torque predicted, and the joint's numbers here come on top of it.",
        joint.joint, fmt::join(joint.trials, ", "), torque.at(torque.lowest_rad), torque.lowest_rad / kDegree,
        torque.at(torque.highest_rad), torque.highest_rad / kDegree);
  }
  return text;
}

/// Returns the meaning of each number that the method estimates.
Table meanings_table(const IdentificationResult& method) {
  Table table{fmt::format("meanings_{}", name(method.method)), "Meaning of the numbers", {}, {"number", "meaning"}};
  std::vector<std::string> seen;
  for (const ParameterEstimate& e : method.estimates) {
    const std::string meaning(page::parameter_meaning(e.parameter));
    if (fit::is_voluntary(e.parameter) || meaning.empty() || std::ranges::find(seen, e.parameter) != seen.end())
      continue;
    seen.push_back(e.parameter);
    table.rows.push_back(page::text_row({page::spelled(e.parameter), meaning}));
  }
  return table;
}

/// Returns true for a number of the largest EMG, for want of a maximal contraction: the truth is that of full effort.
bool is_at_largest_emg(const run::StudyResult& result, const ParameterEstimate& e) {
  const IdentificationResult* const fit = run::torque_of(result.fit);
  const bool of_effort = e.parameter == "max_isometric_force" || fit::is_voluntary(e.parameter);
  return of_effort && fit != nullptr && !fit->voluntary.empty() && !fit->voluntary.front().from_mvc;
}

/// Returns the numbers by the other choice for muscles without EMG.
Table choice_table(const run::OtherChoice& choice, const IdentificationResult& method) {
  Table table{"other_choice",
              "The numbers by another choice for muscles without EMG",
              fmt::format("With {}. Moved: in widths of the 95 % interval to that side.", choice.other),
              {"muscle", "parameter", "unit", "estimate", "95 % interval", "by the other choice", "moved"}};
  for (const ParameterEstimate& e : method.estimates) {
    const run::OtherChoice::Number* number = choice.of(e);
    if (number == nullptr) continue;
    table.rows.push_back(
        page::text_row({e.muscle, page::spelled(e.parameter), unit(e), value_of(e, e.estimate), interval(e)}));
    table.rows.back().insert(table.rows.back().end(),
                             {{value_of(e, number->other)},
                              {fmt::format("{:.2f}", number->moved), number->outside() ? Badge::weak : Badge::none}});
  }
  return table;
}

}  // namespace

std::optional<double> truth_of(const run::StudyResult& result, const ParameterEstimate& e) {
  if (is_at_largest_emg(result, e)) return std::nullopt;
  for (const run::TrueValue& t : result.source.truth) {
    if (t.parameter == e.parameter && (t.muscle == e.muscle || (e.muscle == "subject" && t.parameter == "emg_delay")))
      return t.value;
  }
  return std::nullopt;
}

bool is_undetermined(const ParameterEstimate& e) {
  constexpr double kMeaningless = 1e3;
  // A number that is 0 by nature is compared with its usual spread between people.
  const double usual = fit::zero_by_nature(e.parameter) ? fit::parameter_field(e.parameter).prior_sd : 1e-12;
  const double size = std::max({std::abs(e.initial), std::abs(e.estimate), usual});
  return e.ci_low && e.ci_high && *e.ci_high - *e.ci_low > kMeaningless * size;
}

std::vector<EstimateLine> estimate_lines(const IdentificationResult& method, std::size_t muscle_count) {
  struct Group {
    const ParameterEstimate* first;
    std::vector<std::string> owners;
  };
  std::vector<Group> groups;
  for (const bool nuisance : {false, true}) {
    for (const ParameterEstimate& e : method.estimates) {
      if (fit::is_nuisance(e) != nuisance || fit::is_voluntary(e.parameter)) continue;
      const auto same = std::ranges::find_if(groups, [&](const Group& group) {
        const ParameterEstimate& first = *group.first;
        // Parameters tied by a ratio have different values.
        return !e.tied_to.empty() && first.muscle == e.tied_to && first.parameter == e.parameter &&
               first.estimate == e.estimate && first.verdict == e.verdict;
      });
      if (same == groups.end())
        groups.push_back({&e, {e.muscle}});
      else
        same->owners.push_back(e.muscle);
    }
  }
  // An unknown shared by all muscles comes after the unknowns of single muscles.
  std::stable_partition(groups.begin(), groups.end(), [](const Group& group) {
    return group.owners.size() == 1 && !fit::is_nuisance(*group.first) && group.first->muscle != "subject";
  });
  std::vector<EstimateLine> lines;
  for (const Group& group : groups) {
    lines.push_back({group.first, group.owners.size() > 1 && group.owners.size() == muscle_count
                                      ? std::string("all muscles")
                                      : fmt::format("{}", fmt::join(group.owners, ", "))});
  }
  return lines;
}

std::string plain_owner(const EstimateLine& line) {
  if (line.owners == "subject") return "Person";
  return line.owners == line.estimate->muscle ? page::plain_muscle(line.owners) : line.owners;
}

std::vector<Table> estimate_tables(const run::StudyResult& result, const IdentificationResult& method) {
  const bool known = !result.source.truth.empty();
  const bool readings = std::ranges::any_of(method.estimates, [](const auto& e) { return e.given_ci_low.has_value(); });
  const std::string truth = known ? " Truth: green where it lies in the interval, else yellow." : "";
  const std::string by =
      method.method == fit::Method::force
          ? "Every muscle alone, both branches at once, against the force that force sharing assigned to it. "
          : "All muscles and both branches at once against the joint torque. ";
  Table muscles{
      fmt::format("parameters_{}", name(method.method)),
      fmt::format("Identified parameters (method {})", name(method.method)),
      by +
          (readings ? "95 % interval: of the person. Given: the 95 % interval if geometry and sensors were exact, by "
                      "which sessions of the person are compared."
                    : "Interval: 95 %, for correlated residuals, if geometry and sensors are exact.") +
          " Prior: the literature's mean ± standard deviation." + truth,
      {"muscle", "parameter", "unit", "prior", "estimate", "95 % interval"}};
  if (readings) muscles.columns.emplace_back("given geometry and sensors");
  if (known) muscles.columns.emplace_back("truth");
  muscles.columns.insert(muscles.columns.end(), {"verdict", "why"});
  Table others{fmt::format("nuisances_{}", name(method.method)), "Numbers of the electrodes and of the joint",
               "Free, so that their uncertainty widens the muscles' intervals; they belong to no muscle and are not "
               "counted above." +
                   measured_at_rest(result) + truth,
               muscles.columns};
  others.columns.front() = "of";
  for (const EstimateLine& line : estimate_lines(method, result.fit_input.data.muscles.size())) {
    const ParameterEstimate& e = *line.estimate;
    std::vector<Cell> row = page::text_row(
        {line.owners, page::spelled(e.parameter), unit(e), prior(e), value_of(e, e.estimate), interval(e)});
    if (readings) row.push_back({given_interval(e)});
    if (known) row.push_back(truth_cell(result, e));
    row.insert(row.end(), {verdict_cell(e), {e.reason}});
    (fit::is_nuisance(e) ? others : muscles).rows.push_back(std::move(row));
  }
  std::vector<Table> tables{std::move(muscles)};
  if (!others.rows.empty()) tables.push_back(std::move(others));
  if (result.fit.other_choice && method.method == fit::Method::torque)
    tables.push_back(choice_table(*result.fit.other_choice, method));
  tables.push_back(meanings_table(method));
  return tables;
}

std::vector<page::ForestRow> forest_rows(const run::StudyResult& result, const IdentificationResult& method) {
  std::vector<page::ForestRow> rows;
  for (const EstimateLine& line : estimate_lines(method, result.fit_input.data.muscles.size())) {
    const ParameterEstimate& e = *line.estimate;
    if (!std::isfinite(e.estimate)) continue;
    const page::PlainUnit plain = page::plain_unit(e.unit);
    const auto scaled = [&](const std::optional<double>& x) { return x ? std::optional(*x * plain.per_si) : x; };
    page::ForestRow row{.owner = plain_owner(line),
                        .name = page::spelled(e.parameter),
                        .unit = std::string(plain.symbol),
                        .estimate = e.estimate * plain.per_si,
                        .lower = scaled(e.ci_low),
                        .upper = scaled(e.ci_high),
                        .given_estimate = scaled(e.given_estimate),
                        .given_lower = scaled(e.given_ci_low),
                        .given_upper = scaled(e.given_ci_high),
                        .prior_mean = scaled(e.prior_mean),
                        .prior_sd = scaled(e.prior_sd),
                        .truth = scaled(truth_of(result, e)),
                        .verdict = page::spelled(fit::name(e.verdict)),
                        .badge = run::verdict_badge(e.verdict),
                        .why = e.reason,
                        .about = std::string(page::parameter_meaning(e.parameter)),
                        .beside = fit::is_nuisance(e)};
    if (is_undetermined(e)) row.lower = row.upper = row.given_lower = row.given_upper = std::nullopt;
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Table> basin_tables(const IdentificationResult& method) {
  if (method.basins.empty()) return {};
  Table table{
      fmt::format("basins_{}", name(method.method)),
      fmt::format("Where the searches from several starts ended (method {})", name(method.method)),
      "The given start and points spread evenly over two standard deviations of the priors. Distance: from the best "
      "minimum, root mean square over the unknowns, in these standard deviations. A second minimum of equal cost is an "
      "equally good answer.",
      {"fit", "cost", "starts", "of them converged", "distance", "the given start"}};
  for (const fit::BasinTable& searches : method.basins) {
    for (const fit::BasinRow& basin : searches.basins) {
      const bool other_answer = basin.rival && &basin != searches.basins.data();
      table.rows.push_back(
          {{searches.fit},
           {fmt::format("{:.6g}", basin.cost)},
           {fmt::format("{}", basin.starts)},
           {fmt::format("{}", basin.converged), basin.converged < basin.starts ? Badge::weak : Badge::none},
           other_answer ? Cell{fmt::format("{:.2g}", basin.distance), Badge::weak, "as good as the best"}
                        : Cell{fmt::format("{:.2g}", basin.distance)},
           {basin.given ? "ends here" : ""}});
    }
    if (searches.failed > 0)
      table.rows.push_back(
          {{searches.fit}, {"none found", Badge::weak}, {fmt::format("{}", searches.failed)}, {"0"}, {"–"}, {""}});
  }
  return {table};
}

}  // namespace myoid::results
