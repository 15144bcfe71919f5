#include "myoid/results/paper_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/page/tables.h"
#include "myoid/results/parameter_tables.h"
#include "myoid/run/design/verdict_badge.h"

namespace myoid::results {
namespace {

using fit::IdentificationResult;
using fit::ParameterEstimate;
using fit::PublishedSearch;
using math::Termination;
using page::Cell;
using page::Table;

/// A column of the paper's tables.
struct PaperColumn {
  std::string_view parameter;
  std::string_view heading;
};
constexpr std::array<PaperColumn, 3> kShortening{
    {{"optimal_fiber_length", "l_m⁰ [m]"}, {"force_length_width", "l_mˢʰ [m]"}, {"concentric_curvature", "V_sh"}}};
constexpr std::array<PaperColumn, 4> kLengthening{{{"optimal_fiber_length", "l_m⁰ [m]"},
                                                   {"force_length_width", "l_mˢʰ [m]"},
                                                   {"eccentric_curvature_product", "V_sh V_shl"},
                                                   {"eccentric_plateau", "V_ml"}}};

std::string steps(int count, std::string_view kind = "step") { return counted(static_cast<std::size_t>(count), kind); }

std::string ended(const PublishedSearch& search) {
  if (search.termination == Termination::converged)
    return fmt::format("minimum of the published criterion after {}",
                       steps(search.iterations, search.damped ? "damped step" : "step"));
  if (search.iterations == 0) return search.message;
  return fmt::format("no minimum after {}: {}", steps(search.iterations), search.message);
}

std::string plain_ended(const PublishedSearch& search) {
  const std::string after = " after " + steps(search.plain_iterations);
  if (search.plain == Termination::converged)
    return (search.plain_elsewhere ? "converged to another point" : "the same minimum") + after;
  return (search.plain == Termination::iteration_limit ? "not converged" : "diverged") + after;
}

/// Returns true if the branch has no fit, for want of samples or force.
bool without_search(const PublishedSearch& search) {
  return search.iterations == 0 && search.plain_iterations == 0 && !search.message.empty();
}

const ParameterEstimate* estimate_of(const IdentificationResult& method,
                                     const PublishedSearch& search,
                                     std::string_view parameter) {
  const auto found = std::ranges::find_if(method.estimates, [&](const ParameterEstimate& e) {
    return e.muscle == search.muscle && e.fit_case == search.fit_case && e.parameter == parameter;
  });
  return found == method.estimates.end() ? nullptr : &*found;
}

Cell estimate_cell(const ParameterEstimate* e, bool searched) {
  if (e == nullptr) return {"held"};
  if (!searched || !std::isfinite(e->estimate)) return {"–", page::Badge::none, e->reason};
  std::string text = page::format_value(e->estimate);
  if (e->ci_low && e->ci_high && !is_undetermined(*e))
    text += fmt::format(" ({})", page::format_interval(*e->ci_low, *e->ci_high));
  return {std::move(text), run::verdict_badge(e->verdict), e->reason};
}

Table branch_table(const IdentificationResult& method,
                   fit::FitCase branch,
                   std::string title,
                   std::span<const PaperColumn> columns) {
  Table table{.id = fmt::format("table_{}_{}", branch == fit::FitCase::shortening ? 1 : 2, name(branch)),
              .title = std::move(title),
              .caption =
                  "Each muscle alone: x_init is the literature's, x̂ the minimum of the published criterion "
                  "C = ½ Σ (F_t − F_m(x))², by Gauss-Newton steps that are halved until it falls; where they find "
                  "none, by damped steps.",
              .columns = {"muscle", "x"}};
  for (const PaperColumn& column : columns) table.columns.emplace_back(column.heading);
  table.columns.emplace_back("C [N²]");
  for (const PublishedSearch& search : method.published) {
    if (search.fit_case != branch) continue;
    const bool searched = !without_search(search);
    std::vector<Cell> start{{search.muscle}, {"x_init"}}, found{{search.muscle}, {"x̂"}};
    for (const PaperColumn& column : columns) {
      const ParameterEstimate* e = estimate_of(method, search, column.parameter);
      start.push_back({e == nullptr ? "held" : page::format_value(e->initial)});
      found.push_back(estimate_cell(e, searched));
    }
    start.push_back({searched ? page::format_value(search.start_cost, 4) : "–"});
    found.push_back({searched ? page::format_value(search.cost, 4) : "–"});
    table.rows.push_back(std::move(start));
    table.rows.push_back(std::move(found));
  }
  return table;
}

}  // namespace

std::vector<Table> paper_tables(const IdentificationResult& method) {
  Table searches{.id = "published_searches",
                 .title = "The searches",
                 .caption =
                     "Plain steps, each in full, are the published search. They reach the minimum from a start "
                     "that is near enough.",
                 .columns = {"muscle", "branch", "steps that lower the criterion", "plain steps"}};
  for (const PublishedSearch& search : method.published)
    searches.rows.push_back({{search.muscle},
                             {std::string(name(search.fit_case))},
                             {ended(search)},
                             {without_search(search) ? "–" : plain_ended(search)}});
  return {
      branch_table(method, fit::FitCase::shortening, "Table I: parameters from shortening (method paper)", kShortening),
      branch_table(method, fit::FitCase::lengthening, "Table II: parameters from lengthening (method paper)",
                   kLengthening),
      std::move(searches)};
}

Table solver_table(const std::vector<run::SolverContest>& contests) {
  Table table{.id = "solvers",
              .title = "Solvers of the published criterion: cost [N²], distance from the best minimum",
              .columns = {"fit", "solver", "start", "cost", "distance", "evaluations", "seconds", "termination"}};
  using ground::format_number;
  for (const run::SolverContest& contest : contests)
    for (const run::SolverRun& run : contest.runs)
      table.rows.push_back(page::text_row(
          {contest.fit, run.solver, fmt::format("{}", run.start), format_number(run.cost), format_number(run.distance),
           fmt::format("{}", run.evaluations), format_number(run.seconds), std::string(math::name(run.termination))}));
  return table;
}

page::Section paper_section(const run::StudyFit& fit, bool shared) {
  const IdentificationResult& paper = *run::method_of(fit, fit::Method::paper);
  page::Section section{
      .id = "paper",
      .heading = "The source paper's method beside it",
      .folded = true,
      .paragraphs = {shared ? "Published in 2006: every muscle alone, shortening and lengthening apart, against forces "
                              "that an optimization assigned and nobody measured. They know nothing of co-contraction "
                              "or of the person's own strength: none of the numbers is a result of this recording."
                            : "Published in 2006: every muscle alone, shortening and lengthening apart, against the "
                              "forces given. It holds F_max and v_max: an error in them goes into every number."},
      .tables = paper_tables(paper)};
  if (!fit.contests.empty()) section.tables.push_back(solver_table(fit.contests));
  for (Table& table : basin_tables(paper)) section.tables.push_back(std::move(table));
  return section;
}

}  // namespace myoid::results
