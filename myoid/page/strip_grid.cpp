#include "myoid/page/strip_grid.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "myoid/page/svg_plot.h"
#include "myoid/page/tables.h"
#include "myoid/page/typeset.h"
#include "myoid/page/verdict_mark.h"

namespace myoid::page {
namespace {

constexpr std::size_t kMostInName = 100;  // characters

std::string shown_name(std::string_view name) { return escape_xml(elided(name, kMostInName)); }

bool is_told(const StripCell& cell) {
  return cell.value && (cell.badge == Badge::good || cell.badge == Badge::repeat || cell.badge == Badge::weak);
}

bool has_given(const StripCell& cell) { return cell.given_lower && cell.given_upper; }

/// Widens a range so that it holds x.
void hold(StripScale& scale, double x) {
  scale.lower = std::min(scale.lower, x);
  scale.upper = std::max(scale.upper, x);
}

double percent(const StripScale& scale, double x) {
  return 100.0 * std::clamp((x - scale.lower) / (scale.upper - scale.lower), 0.0, 1.0);
}

std::string sentence(const StripRow& row, const StripColumn& column, const StripCell& cell) {
  std::string text = fmt::format("{}, {}: {}", elided(row.person, kMostInName), column.name,
                                 format_beside(*cell.value, cell.lower, cell.upper));
  if (!column.unit.empty()) text += ' ' + column.unit;
  if (cell.lower && cell.upper) text += fmt::format(", 95 % interval {}", format_interval(*cell.lower, *cell.upper));
  if (has_given(cell))
    text += fmt::format(", given geometry and sensors {}", format_interval(*cell.given_lower, *cell.given_upper));
  if (cell.truth) text += fmt::format(", truth {}", format_value(*cell.truth));
  if (!cell.verdict.empty()) text += ", " + spelled(cell.verdict);
  if (cell.outlier) text += ", far from the other persons";
  return text;
}

std::string background(const StripColumn& column, const StripScale& scale) {
  std::string svg;
  if (column.spread_low && column.spread_high)
    svg += fmt::format("<rect x=\"{:.2f}%\" width=\"{:.2f}%\" y=\"0\" height=\"20\" class=\"spread\"/>",
                       percent(scale, *column.spread_low),
                       percent(scale, *column.spread_high) - percent(scale, *column.spread_low));
  if (column.middle)
    svg += fmt::format("<line x1=\"{0:.2f}%\" x2=\"{0:.2f}%\" y1=\"0\" y2=\"20\" class=\"middle\"/>",
                       percent(scale, *column.middle));
  return svg;
}

std::string interval_drawing(const StripCell& cell, const StripScale& scale) {
  if (!cell.lower || !cell.upper) return "";
  const std::string_view color = verdict_color(cell.badge);
  const auto line = [&](double from, double to, int width) {
    return fmt::format("<line x1=\"{:.2f}%\" x2=\"{:.2f}%\" y1=\"10\" y2=\"10\" stroke=\"{}\" stroke-width=\"{}\"/>",
                       percent(scale, from), percent(scale, to), color, width);
  };
  std::string svg = line(*cell.lower, *cell.upper, 2);
  if (has_given(cell)) svg += line(*cell.given_lower, *cell.given_upper, 6);
  if (*cell.lower < scale.lower) svg += beyond_arrow(-1, color);
  if (*cell.upper > scale.upper) svg += beyond_arrow(1, color);
  return svg;
}

std::string cell_html(const StripRow& row, const StripColumn& column, const StripCell& cell, const StripScale& scale) {
  std::string svg = "<td><svg class=\"strip\" role=\"img\">";
  if (!cell.value)
    return svg + fmt::format("<title>{}, {}: none</title>{}</svg></td>", shown_name(row.person),
                             escape_xml(column.name), background(column, scale));
  svg += fmt::format("<title>{}</title>", escape_xml(typographic(sentence(row, column, cell))));
  svg += background(column, scale);
  const bool faint = !cell.verdict.empty() && !is_told(cell);
  svg += fmt::format("<g{}>{}", faint ? " class=\"untold\"" : "", interval_drawing(cell, scale));
  if (cell.truth)
    svg += fmt::format("<line x1=\"{0:.2f}%\" x2=\"{0:.2f}%\" y1=\"1\" y2=\"19\" class=\"truth\"/>",
                       percent(scale, *cell.truth));
  return svg + fmt::format("<svg x=\"{:.2f}%\" y=\"50%\" overflow=\"visible\">{}{}</svg></g></svg></td>",
                           percent(scale, *cell.value), verdict_shape(cell.badge),
                           cell.outlier ? "<circle r=\"9\" class=\"ring\"/>" : "");
}

std::string head_html(const StripColumn& column, const StripScale& scale) {
  const double width = scale.upper - scale.lower;
  return fmt::format("<th>{}{}<small><span>{}</span><span>{}</span></small></th>", typeset(spelled(column.name)),
                     column.unit.empty() ? "" : " [" + escape_xml(column.unit) + "]",
                     format_rounded(scale.lower, width), format_rounded(scale.upper, width));
}

std::string legend(const StripGrid& grid) {
  std::string text = "<p class=\"legend\">";
  bool outliers = false, truths = false, readings = false;
  for (const Badge badge : {Badge::good, Badge::repeat, Badge::weak, Badge::info, Badge::none, Badge::bad}) {
    std::string verdict;
    for (const StripRow& row : grid.rows) {
      for (const StripCell& cell : row.cells) {
        if (cell.value && cell.badge == badge && verdict.empty()) verdict = cell.verdict;
        outliers = outliers || cell.outlier;
        truths = truths || cell.truth;
        readings = readings || has_given(cell);
      }
    }
    if (!verdict.empty()) text += fmt::format("<span>{} {}</span> ", verdict_mark(badge), typeset(spelled(verdict)));
  }
  if (readings)
    text +=
        "<span>\u2014 95 % interval of the person</span> <span><b>\u2501</b> the same if geometry and sensors were "
        "exact</span> ";
  if (outliers)
    text +=
        "<span><svg class=\"mark\" width=\"20\" height=\"20\" viewBox=\"-10 -10 20 20\" "
        "aria-hidden=\"true\"><circle r=\"8\" class=\"ring\"/></svg> outlier</span> ";
  if (truths) text += "<span><i class=\"truth\"></i> truth of the virtual person</span>";
  return text + "</p>\n";
}

}  // namespace

StripScale strip_scale(const StripGrid& grid, std::size_t column) {
  const bool any = std::ranges::any_of(grid.rows, [&](const StripRow& row) { return is_told(row.cells[column]); });
  const auto counts = [&](const StripCell& cell) { return any ? is_told(cell) : !!cell.value; };
  constexpr double kMost = std::numeric_limits<double>::max();
  StripScale values{kMost, -kMost};
  for (const StripRow& row : grid.rows)
    if (counts(row.cells[column])) hold(values, *row.cells[column].value);
  if (values.lower > values.upper) return {};
  const StripColumn& of = grid.columns[column];
  for (const std::optional<double>& x : {of.middle, of.spread_low, of.spread_high})
    if (x) hold(values, *x);
  std::vector<double> widths;
  for (const StripRow& row : grid.rows) {
    const StripCell& cell = row.cells[column];
    if (counts(cell) && cell.lower && cell.upper) widths.push_back(*cell.upper - *cell.lower);
  }
  double range = values.upper - values.lower;
  if (!widths.empty()) {
    const auto middle = widths.begin() + static_cast<std::ptrdiff_t>((widths.size() - 1) / 2);
    std::nth_element(widths.begin(), middle, widths.end());
    range = std::max(range, *middle);
  }
  if (!(range > 0.0)) range = values.lower == 0.0 ? 1.0 : 0.2 * std::abs(values.lower);
  StripScale scale = values;
  for (const StripRow& row : grid.rows) {
    const StripCell& cell = row.cells[column];
    if (!counts(cell)) continue;
    if (cell.lower) hold(scale, std::max(*cell.lower, values.lower - range));
    if (cell.upper) hold(scale, std::min(*cell.upper, values.upper + range));
  }
  return {scale.lower - 0.05 * range, scale.upper + 0.05 * range};
}

std::string strip_grid_html(const StripGrid& grid) {
  std::string text = fmt::format("<figure id=\"{}\" class=\"grid\">\n<h3>{}</h3>\n{}", escape_xml(grid.id),
                                 typeset(grid.title), legend(grid));
  text += "<table><thead><tr><th>person</th>";
  std::vector<StripScale> scales;
  for (std::size_t c = 0; c < grid.columns.size(); ++c) {
    scales.push_back(strip_scale(grid, c));
    text += head_html(grid.columns[c], scales.back());
  }
  text += "</tr></thead>\n<tbody>\n";
  for (const StripRow& row : grid.rows) {
    const std::string name = shown_name(row.person);
    text += row.page.empty()
                ? fmt::format("<tr><td title=\"{0}\">{0}</td>", name)
                : fmt::format("<tr><td title=\"{0}\"><a href=\"{1}\">{0}</a></td>", name, url_path(row.page));
    for (std::size_t c = 0; c < grid.columns.size(); ++c)
      text += cell_html(row, grid.columns[c], row.cells[c], scales[c]);
    text += "</tr>\n";
  }
  return text + fmt::format(
                    "</tbody></table>\n<figcaption>{}</figcaption>\n<p class=\"save\"><a "
                    "href=\"tables/{}.csv\">CSV</a></p>\n</figure>\n",
                    typeset(grid.caption), escape_xml(grid.id));
}

std::string strip_grid_csv(const StripGrid& grid) {
  Table table{.columns = {"person", "number", "unit", "value", "lower", "upper", "given_value", "given_lower",
                          "given_upper", "truth", "verdict", "outlier"}};
  const auto number = [](const std::optional<double>& x) { return x ? fmt::format("{}", *x) : ""; };
  for (const StripRow& row : grid.rows) {
    for (std::size_t c = 0; c < grid.columns.size(); ++c) {
      const StripCell& cell = row.cells[c];
      if (!cell.value) continue;
      table.rows.push_back(
          text_row({row.person, grid.columns[c].name, grid.columns[c].unit, number(cell.value), number(cell.lower),
                    number(cell.upper), number(cell.given_value), number(cell.given_lower), number(cell.given_upper),
                    number(cell.truth), cell.verdict, cell.outlier ? "yes" : "no"}));
    }
  }
  return table_csv(table);
}

}  // namespace myoid::page
