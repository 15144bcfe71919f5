#include "myoid/results/cohort/group_page.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/page/tables.h"
#include "myoid/page/typeset.h"
#include "myoid/run/design/verdict_badge.h"

namespace myoid::results {
namespace {

using page::Badge;
using page::Cell;
using page::StripCell;
using page::StripColumn;
using page::StripGrid;

constexpr double kRobust = 1.4826;  // standard deviation over the median absolute deviation, normal
constexpr std::size_t kMostNamed = 3;
// A page that a browser opens at once, whatever the number of persons.
constexpr std::size_t kMostDrawn = 60, kMostCells = 6000, kMostRows = 200;

/// Median and robust standard deviation.
struct Spread {
  double median = 0.0, sd = 0.0;
};

Spread spread_of(const std::vector<double>& values) {
  const double middle = math::median(values);
  std::vector<double> off;
  for (const double x : values) off.push_back(std::abs(x - middle));
  return {middle, kRobust * math::median(std::move(off))};
}

Badge status_badge(page::GateStatus status) {
  switch (status) {
    case page::GateStatus::pass:
      return Badge::good;
    case page::GateStatus::warn:
      return Badge::weak;
    case page::GateStatus::fail:
      return Badge::bad;
    case page::GateStatus::info:
      break;
  }
  return Badge::info;
}

StripCell cell_of(const Quality& quality) {
  return {.value = quality.value,
          .lower = {},
          .upper = {},
          .given_value = {},
          .given_lower = {},
          .given_upper = {},
          .truth = {},
          .verdict = quality.status ? std::string(page::spelled(*quality.status)) : "",
          .badge = status_badge(quality.status.value_or(page::GateStatus::info))};
}

StripCell cell_of(const GroupNumber& number) {
  return {.value = number.estimate,
          .lower = number.low,
          .upper = number.high,
          .given_value = number.given,
          .given_lower = number.given_low,
          .given_upper = number.given_high,
          .truth = number.truth,
          .verdict = std::string(name(number.verdict)),
          .badge = run::verdict_badge(number.verdict)};
}

bool counts(const StripCell& cell) {
  return cell.value && (cell.verdict.empty() || cell.badge == Badge::good || cell.badge == Badge::repeat ||
                        cell.badge == Badge::weak);
}

/// Marks the outliers of a column, and draws median and spread behind it.
void judge(StripGrid& grid, std::size_t column, std::string_view name, std::vector<Outlier>& outliers) {
  std::vector<double> values;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < grid.rows.size(); ++i) {
    const StripCell& cell = grid.rows[i].cells[column];
    if (!counts(cell)) continue;
    values.push_back(*cell.value);
    rows.push_back(i);
  }
  if (values.size() < 2) return;
  StripColumn& of = grid.columns[column];
  const Spread spread = spread_of(values);
  of.middle = spread.median;
  of.spread_low = spread.median - spread.sd;
  of.spread_high = spread.median + spread.sd;
  const std::vector<double> distance = robust_distances(values);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (!(std::abs(distance[k]) > kOutlierDistance)) continue;
    grid.rows[rows[k]].cells[column].outlier = true;
    outliers.push_back({.person = grid.rows[rows[k]].person,
                        .number = std::string(name),
                        .unit = of.unit,
                        .value = values[k],
                        .median = spread.median,
                        .distance = distance[k]});
  }
}

/// Returns a grid whose cells are still empty.
StripGrid empty_grid(const std::vector<GroupPerson>& persons, std::string id, std::string title) {
  StripGrid grid{.id = std::move(id), .title = std::move(title), .caption = {}, .columns = {}, .rows = {}};
  for (const GroupPerson& person : persons)
    grid.rows.push_back({.person = person.name, .page = person.page, .cells = {}});
  return grid;
}

/// Returns the column of this name; adds a new one if there is none.
std::size_t column_of(StripGrid& grid, const std::string& name, const std::string& unit) {
  const auto found = std::ranges::find_if(grid.columns, [&](const StripColumn& c) { return c.name == name; });
  if (found != grid.columns.end()) return static_cast<std::size_t>(found - grid.columns.begin());
  grid.columns.push_back({.name = name, .unit = unit, .middle = {}, .spread_low = {}, .spread_high = {}});
  for (page::StripRow& row : grid.rows) row.cells.emplace_back();
  return grid.columns.size() - 1;
}

StripGrid quality_grid(const std::vector<GroupPerson>& persons, std::vector<Outlier>& outliers) {
  StripGrid grid = empty_grid(persons, "group_quality", "Quality of recordings and fits");
  grid.caption =
      "Questions not passed: green disc none, orange diamond a caution, red triangle a failure; the person's report "
      "names them. R2 and torque error of trials left out are medians over the trials, predicted by fits that did not "
      "see them.";
  for (std::size_t i = 0; i < persons.size(); ++i) {
    for (const Quality& quality : persons[i].quality) {
      const std::size_t column = column_of(grid, quality.name, quality.unit);
      grid.rows[i].cells[column] = cell_of(quality);
    }
  }
  for (std::size_t c = 0; c < grid.columns.size(); ++c) {
    if (grid.columns[c].name != "questions not passed") judge(grid, c, grid.columns[c].name, outliers);
  }
  return grid;
}

/// Returns one grid per parameter, in the order in which the parameters appear.
std::vector<StripGrid> number_grids(const std::vector<GroupPerson>& persons, std::vector<Outlier>& outliers) {
  std::vector<StripGrid> grids;
  for (std::size_t i = 0; i < persons.size(); ++i) {
    for (const GroupNumber& number : persons[i].numbers) {
      const std::string id = "group_" + number.parameter;
      auto grid = std::ranges::find_if(grids, [&](const StripGrid& g) { return g.id == id; });
      if (grid == grids.end())
        grid = grids.insert(grids.end(), empty_grid(persons, id, page::spelled(number.parameter)));
      grid->caption =
          "A row is a person: mark and 95 % interval of the person; the thick bar is the interval if moment arms, "
          "tendons "
          "and sensors were exact, by which sessions of one person are compared. Behind them median and robust "
          "standard deviation of the numbers "
          "that the recordings tell; pale: a number that the recording does not tell.";
      const std::size_t column = column_of(*grid, number.muscle, number.unit);
      grid->rows[i].cells[column] = cell_of(number);
    }
  }
  for (StripGrid& grid : grids) {
    for (std::size_t c = 0; c < grid.columns.size(); ++c)
      judge(grid, c, fmt::format("{} {}", grid.columns[c].name, grid.title), outliers);
  }
  return grids;
}

/// Returns the persons that are drawn, in their order: those with the most outliers, then the first ones. `cells`:
/// numbers of one person.
std::vector<std::size_t> drawn_persons(const std::vector<GroupPerson>& persons,
                                       const std::vector<Outlier>& outliers,
                                       std::size_t cells) {
  std::map<std::string_view, std::size_t> far;
  for (const Outlier& o : outliers) ++far[o.person];
  const auto count = [&](std::size_t i) {
    const auto found = far.find(persons[i].name);
    return found == far.end() ? std::size_t{0} : found->second;
  };
  std::vector<std::size_t> order(persons.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return count(a) > count(b); });
  order.resize(
      std::min({order.size(), kMostDrawn, std::max<std::size_t>(kMostCells / std::max<std::size_t>(cells, 1), 5)}));
  std::ranges::sort(order);
  return order;
}

/// Leaves the rows of these persons. Medians and spreads stay those of all.
void draw_only(StripGrid& grid, const std::vector<std::size_t>& persons) {
  if (persons.size() == grid.rows.size()) return;
  grid.caption += fmt::format(" Drawn are {} of {} persons: those farthest from the others, then the first.",
                              persons.size(), grid.rows.size());
  std::vector<page::StripRow> rows;
  for (const std::size_t i : persons) rows.push_back(std::move(grid.rows[i]));
  grid.rows = std::move(rows);
}

/// Values and intervals of one reading of a number, over the persons.
struct OverPersons {
  std::vector<double> values, half_widths;

  void add(const std::optional<double>& value, const std::optional<double>& low, const std::optional<double>& high) {
    if (value) values.push_back(*value);
    if (value && low && high) half_widths.push_back(0.5 * (*high - *low));
  }

  /// Returns mean, standard deviation between persons and median half width; "-" where there is none.
  [[nodiscard]] std::vector<std::string> texts() const {
    std::vector<std::string> found{"-", "-", "-"};
    if (values.empty()) return found;
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double squares = 0.0;
    for (const double x : values) squares += (x - mean) * (x - mean);
    found[0] = page::format_value(mean);
    if (values.size() > 1) found[1] = page::format_value(std::sqrt(squares / (count - 1.0)));
    if (!half_widths.empty()) found[2] = page::format_value(math::median(half_widths));
    return found;
  }
};

/// Returns a number of a grid over the persons, with `readings` by both; empty if no recording determines it.
std::optional<std::vector<Cell>> summary_row(const StripGrid& grid, std::size_t column, bool readings) {
  OverPersons person, given;
  for (const page::StripRow& row : grid.rows) {
    const StripCell& cell = row.cells[column];
    if (!counts(cell)) continue;
    person.add(cell.value, cell.lower, cell.upper);
    given.add(cell.given_value, cell.given_lower, cell.given_upper);
  }
  if (person.values.empty()) return std::nullopt;
  std::vector<std::string> texts{grid.title, grid.columns[column].name, grid.columns[column].unit,
                                 fmt::format("{} of {}", person.values.size(), grid.rows.size())};
  for (const std::string& text : person.texts()) texts.push_back(text);
  if (readings)
    for (const std::string& text : given.texts()) texts.push_back(text);
  return page::text_row(std::move(texts));
}

page::Table summary_table(const std::vector<StripGrid>& grids) {
  const bool readings = std::ranges::any_of(grids, [](const StripGrid& grid) {
    return std::ranges::any_of(grid.rows, [](const page::StripRow& row) {
      return std::ranges::any_of(row.cells, [](const StripCell& cell) { return cell.given_value.has_value(); });
    });
  });
  page::Table table{.id = "summary",
                    .title = "Numbers that the recordings tell",
                    .caption = "Verdict identified, reproducible or weak. Every person counts once.",
                    .columns = {"parameter", "muscle", "unit", "persons", "mean", "SD between persons",
                                "median half width of the 95 % intervals"},
                    .rows = {}};
  if (readings) {
    table.caption +=
        " The last columns are the same given geometry and sensors: whoever's moment arms, tendons and sensors err "
        "alike may be compared by them.";
    for (const char* name : {"mean, given geometry and sensors", "SD, given geometry and sensors",
                             "median half width, given geometry and sensors"})
      table.columns.emplace_back(name);
  }
  for (const StripGrid& grid : grids) {
    for (std::size_t c = 0; c < grid.columns.size(); ++c) {
      if (std::optional<std::vector<Cell>> row = summary_row(grid, c, readings)) table.rows.push_back(std::move(*row));
    }
  }
  return table;
}

page::Table outlier_table(const std::vector<Outlier>& outliers) {
  page::Table table{.id = "outliers",
                    .title = "Persons far from the others",
                    .caption = fmt::format(
                        "A number farther than {} robust standard deviations (1.4826 times the median absolute "
                        "deviation) from the median of the persons, where {} or more have it. Look at the person's "
                        "report first: a label, unit or electrode is more often the cause than the person.",
                        kOutlierDistance, kFewestForOutliers),
                    .columns = {"person", "number", "value", "median of the persons", "robust SD from it"},
                    .rows = {}};
  for (const Outlier& o : outliers) {
    const std::string unit = o.unit.empty() ? "" : " " + o.unit;
    if (table.rows.size() == kMostRows) {
      table.caption += fmt::format(" The first {} of {}.", kMostRows, outliers.size());
      break;
    }
    table.rows.push_back(page::text_row({o.person, o.number, page::format_value(o.value) + unit,
                                         page::format_value(o.median) + unit, fmt::format("{:+.1f}", o.distance)}));
  }
  return table;
}

}  // namespace

std::vector<double> robust_distances(const std::vector<double>& values) {
  std::vector<double> distances(values.size(), 0.0);
  if (values.size() < kFewestForOutliers) return distances;
  const Spread spread = spread_of(values);
  if (!(spread.sd > 0.0)) return distances;
  std::ranges::transform(values, distances.begin(), [&](double x) { return (x - spread.median) / spread.sd; });
  return distances;
}

GroupPage group_page(const std::vector<GroupPerson>& persons) {
  GroupPage page;
  page.persons.id = "numbers";
  page.persons.heading = "The persons beside each other";
  page.persons.paragraphs.push_back(
      "A row is a person; the name leads to the person's report. The spread of the marks holds the differences between "
      "people and the errors of the estimates.");
  StripGrid quality = quality_grid(persons, page.outliers);
  std::vector<StripGrid> grids = number_grids(persons, page.outliers);
  page::Table summary = summary_table(grids);
  std::size_t cells = quality.columns.size();
  for (const StripGrid& grid : grids) cells += grid.columns.size();
  const std::vector<std::size_t> drawn = drawn_persons(persons, page.outliers, cells);
  draw_only(quality, drawn);
  for (StripGrid& grid : grids) draw_only(grid, drawn);
  if (!quality.columns.empty()) page.persons.grids.push_back(std::move(quality));
  for (StripGrid& grid : grids) page.persons.grids.push_back(std::move(grid));
  if (!page.outliers.empty()) page.persons.tables.push_back(outlier_table(page.outliers));
  if (!summary.rows.empty()) page.persons.tables.push_back(std::move(summary));
  return page;
}

std::string outlier_sentence(const std::vector<Outlier>& outliers) {
  if (outliers.empty()) return "";
  std::vector<std::string> persons;
  for (const Outlier& o : outliers) {
    if (std::ranges::find(persons, o.person) == persons.end()) persons.push_back(o.person);
  }
  std::string text = fmt::format("{} of {} far from the others: ", counted(outliers.size(), "number"),
                                 counted(persons.size(), "person"));
  for (std::size_t i = 0; i < std::min(outliers.size(), kMostNamed); ++i)
    text += fmt::format("{}{}, {}", i == 0 ? "" : "; ", outliers[i].person, outliers[i].number);
  if (outliers.size() > kMostNamed) text += fmt::format("; and {} more, named below", outliers.size() - kMostNamed);
  return text + ".";
}

}  // namespace myoid::results
