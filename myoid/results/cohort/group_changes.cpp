#include "myoid/results/cohort/group_changes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/normal.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/page/plain_unit.h"
#include "myoid/page/tables.h"
#include "myoid/page/typeset.h"
#include "myoid/results/comparison/change_sentences.h"

namespace myoid::results {
namespace {

using page::Badge;

constexpr std::size_t kFewestForGroup = 3;

Badge mark_of(Change change) {
  return change == Change::differs ? Badge::weak : change == Change::no_change ? Badge::good : Badge::none;
}

page::StripCell change_cell(const ComparedParameter& p) {
  const double scale = page::plain_unit(p.first.unit).per_si;
  page::StripCell cell{
      .value = scale * p.difference, .verdict = page::spelled(name(p.change)), .badge = mark_of(p.change)};
  if (p.smallest_detectable) {
    cell.lower = scale * (p.difference - *p.smallest_detectable);
    cell.upper = scale * (p.difference + *p.smallest_detectable);
  }
  return cell;
}

/// Returns a number's place among the grids; adds a new place if there is none.
page::StripCell& place(std::vector<page::StripGrid>& grids,
                       const std::vector<PersonChange>& changes,
                       std::size_t person,
                       const ComparedParameter& p) {
  const std::string id = "change_" + p.first.parameter + branch_text(p.first.fit_case, "_");
  auto grid = std::ranges::find(grids, id, &page::StripGrid::id);
  if (grid == grids.end()) {
    page::StripGrid made{
        .id = id,
        .title = "Change of " + page::spelled(p.first.parameter) + branch_text(p.first.fit_case, ", "),
        .caption =
            "Second session minus first, both given geometry and sensors where the fits have that "
            "reading: errors of moment arms, tendons and sensors are the same in both. The bar is the "
            "smallest change that these two recordings detect, to either side. A bar that does not reach the line is a "
            "change."};
    for (const PersonChange& change : changes) made.rows.push_back({.person = change.person, .page = change.page});
    grid = grids.insert(grids.end(), std::move(made));
  }
  auto column = std::ranges::find(grid->columns, p.muscle, &page::StripColumn::name);
  if (column == grid->columns.end()) {
    const std::string unit(page::plain_unit(p.first.unit).symbol);
    column = grid->columns.insert(column, {.name = p.muscle, .unit = unit, .middle = 0.0});
    for (page::StripRow& row : grid->rows) row.cells.emplace_back();
  }
  return grid->rows[person].cells[static_cast<std::size_t>(column - grid->columns.begin())];
}

/// Adds one number over the persons whose two recordings determine it.
void add_row(const page::StripGrid& grid, std::size_t column, page::Table& table) {
  std::vector<double> differences, detectable;
  std::size_t differ = 0;
  for (const page::StripRow& row : grid.rows) {
    const page::StripCell& cell = row.cells[column];
    if (!cell.value || !cell.lower) continue;
    differences.push_back(*cell.value);
    detectable.push_back(*cell.value - *cell.lower);
    differ += cell.verdict == name(Change::differs);
  }
  if (differences.empty()) return;
  const auto n = static_cast<double>(differences.size());
  const double mean = std::accumulate(differences.begin(), differences.end(), 0.0) / n;
  double squares = 0.0;
  for (const double d : differences) squares += (d - mean) * (d - mean);
  const std::string group =
      differences.size() < kFewestForGroup ? "-" : page::format_value(kNormal95 * std::sqrt(squares / (n - 1.0)));
  table.rows.push_back(
      page::text_row({grid.title.substr(std::string("Change of ").size()), grid.columns[column].name,
                      grid.columns[column].unit, fmt::format("{}", differences.size()), fmt::format("{}", differ),
                      page::format_value(mean), page::format_value(math::median(std::move(detectable))), group}));
}

}  // namespace

page::Section change_section(const std::vector<PersonChange>& changes) {
  page::Section section{.id = "changes", .heading = "From the first session to the second"};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (!changes[i].comparison.one_recording.empty()) {
      section.paragraphs.push_back(fmt::format("{}: {}", changes[i].person, changes_sentence(changes[i].comparison)));
      continue;
    }
    for (const ComparedParameter* p : counted_parameters(changes[i].comparison))
      place(section.grids, changes, i, *p) = change_cell(*p);
    if (!changes[i].comparison.unlike.empty())
      section.paragraphs.push_back(fmt::format("{}: the sessions are not of one kind: {}.", changes[i].person,
                                               fmt::join(changes[i].comparison.unlike, "; ")));
  }
  page::Table table{
      .id = "changes",
      .title = "Changes over the persons",
      .caption =
          "Of persons whose two recordings tell the number. The smallest detectable change of a person follows from "
          "the two intervals given geometry and sensors. That of the group is 1.96 standard deviations of the "
          "differences between persons: for "
          "persons who did not change, it holds every error of a repetition, placing the electrodes anew included.",
      .columns = {"parameter", "muscle", "unit", "persons", "differ", "mean difference",
                  "smallest detectable change, median person", "of the group"}};
  for (const page::StripGrid& grid : section.grids)
    for (std::size_t c = 0; c < grid.columns.size(); ++c) add_row(grid, c, table);
  if (!table.rows.empty()) section.tables.push_back(std::move(table));
  return section;
}

}  // namespace myoid::results
