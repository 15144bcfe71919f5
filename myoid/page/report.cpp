#include "myoid/page/report.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/name_ids.h"

namespace myoid::page {
namespace {

void check_series(const Series& series, const std::string& figure) {
  const std::size_t n = series.x.size();
  const auto wrong = [&](const std::vector<double>& values, bool may_be_empty) {
    return values.size() != n && !(may_be_empty && values.empty());
  };
  if (wrong(series.y, false) || wrong(series.y_lower, true) || wrong(series.y_upper, series.role != Role::band)) {
    throw InvalidInput(
        fmt::format("figure \"{}\", series \"{}\": {} x, {} y, {} y_lower and {} y_upper; expected one length", figure,
                    series.name, n, series.y.size(), series.y_lower.size(), series.y_upper.size()));
  }
}

}  // namespace

void validate(const Report& report) {
  for (const Section& section : report.sections) {
    for (const Table& table : section.tables) {
      for (const std::vector<Cell>& row : table.rows) {
        if (row.size() != table.columns.size() || row.empty()) {
          throw InvalidInput(fmt::format("table \"{}\": a row of {} cells under {} columns", table.id, row.size(),
                                         table.columns.size()));
        }
      }
    }
    for (const StripGrid& grid : section.grids) {
      for (const StripRow& row : grid.rows) {
        if (row.cells.size() != grid.columns.size())
          throw InvalidInput(fmt::format("strip plot \"{}\": a row of {} cells under {} columns", grid.id,
                                         row.cells.size(), grid.columns.size()));
      }
    }
    for (const Figure& figure : section.figures) {
      for (const Panel& panel : figure.panels) {
        for (const Series& series : panel.series) check_series(series, figure.id);
      }
    }
  }
}

void make_ids(Report& report) {
  std::vector<std::string*> sections, tables, figures;
  for (Section& section : report.sections) {
    sections.push_back(&section.id);
    for (Table& table : section.tables) tables.push_back(&table.id);
    for (StripGrid& grid : section.grids) tables.push_back(&grid.id);
    for (Figure& figure : section.figures) figures.push_back(&figure.id);
  }
  for (const auto& places : {sections, tables, figures}) {
    std::vector<std::string> names;
    for (const std::string* id : places) names.push_back(*id);
    const std::vector<std::string> ids = ids_of(names);
    for (std::size_t i = 0; i < ids.size(); ++i) *places[i] = ids[i];
  }
}

std::vector<double> to_vector(const Eigen::Ref<const Eigen::VectorXd>& samples) {
  return {samples.begin(), samples.end()};
}

Panel time_panel(std::string title, std::string label, std::string unit) {
  return {.title = std::move(title),
          .x = {.label = "time", .unit = "s"},
          .y = {.label = std::move(label), .unit = std::move(unit)}};
}

std::string format_value(double value, int digits) {
  if (std::isnan(value)) return "\u2013";
  if (std::isinf(value)) return value > 0 ? "\u221e" : "\u2212\u221e";
  if (value == 0.0) return "0";
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value))));
  if (magnitude < -4 || magnitude >= 6) return fmt::format("{:.{}e}", value, digits - 1);
  std::string text = fmt::format("{:.{}f}", value, std::max(0, digits - 1 - magnitude));
  // Trailing zeros say nothing here: the interval states the precision.
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text;
}

std::string format_rounded(double value, double width) {
  const double size = std::abs(value);
  width = std::abs(width);
  if (!std::isfinite(value) || !std::isfinite(width) || !(width > 0.0) || (size > 0.0 && size < 1e-4 && width < 1e-4) ||
      size >= 1e6)
    return format_value(value);
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(width))), 0, 9);
  std::string text = fmt::format("{:.{}f}", value, decimals);
  // No minus before a zero.
  if (text.front() == '-' && text.find_first_of("123456789") == std::string::npos) text.erase(0, 1);
  return text;
}

std::string format_beside(double value, const std::optional<double>& lower, const std::optional<double>& upper) {
  return lower && upper ? format_rounded(value, *upper - *lower) : format_value(value);
}

std::string format_interval(double lower, double upper, std::string_view between) {
  const double width = upper - lower;
  const double size = std::max(std::abs(lower), std::abs(upper));
  if (!std::isfinite(width) || size < 1e-4 || size >= 1e6)
    return format_value(lower) + std::string(between) + format_value(upper);
  return format_rounded(lower, width) + std::string(between) + format_rounded(upper, width);
}

}  // namespace myoid::page
