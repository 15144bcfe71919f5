#include "myoid/recording/csv_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"

namespace myoid::recording {
namespace {

std::vector<std::string> csv_cells(std::string_view line, char separator) {
  std::vector<std::string> cells;
  std::string cell;
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted) {
      if (c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
        cell += line[++i];
      } else if (c == '"') {
        quoted = false;
      } else {
        cell += c;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == separator) {
      cells.emplace_back(trim(cell));
      cell.clear();
    } else {
      cell += c;
    }
  }
  cells.emplace_back(trim(cell));
  return cells;
}

/// "name [unit]" or "name (unit)" taken apart.
struct NamedUnit {
  std::string name;
  std::optional<ScaledUnit> unit;
};

/// "[mV]" and "(mV)" without their brackets.
std::string_view trim_brackets(std::string_view cell) {
  if (cell.size() > 2 && ((cell.front() == '[' && cell.back() == ']') ||
                          (cell.front() == '(' && cell.back() == ')'))) {
    cell.remove_prefix(1);
    cell.remove_suffix(1);
  }
  return cell;
}

NamedUnit take_apart(const std::string& label) {
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const std::size_t begin = label.rfind(open);
    const std::size_t end = label.rfind(close);
    if (begin == std::string::npos || end == std::string::npos || end < begin) continue;
    if (auto unit = parse_unit(std::string_view(label).substr(begin + 1, end - begin - 1))) {
      return {std::string(trim(std::string_view(label).substr(0, begin))), unit};
    }
  }
  return {label, std::nullopt};
}

bool is_time(std::string_view name) {
  return equal_ignoring_case(name, "time") || equal_ignoring_case(name, "t") ||
         equal_ignoring_case(name, "time_s") || equal_ignoring_case(name, "times") ||
         equal_ignoring_case(name, "time_ms");
}

/// If the first row holds units instead of numbers ("s", "mV", ...), gives them to the labels that
/// have none.
bool take_units_row(const CsvTable& table, std::vector<NamedUnit>& labels) {
  if (table.rows.empty()) return false;
  bool any = false;
  for (const std::string& cell : table.rows[0]) {
    if (cell.empty()) continue;
    if (parse_number(cell) || !parse_unit(trim_brackets(cell))) return false;
    any = true;
  }
  for (std::size_t c = 0; any && c < labels.size(); ++c) {
    if (!labels[c].unit && !table.rows[0][c].empty())
      labels[c].unit = parse_unit(trim_brackets(table.rows[0][c]));
  }
  return any;
}

}  // namespace

CsvTable parse_csv_table(std::string_view text, const std::filesystem::path& path) {
  const std::vector<std::string_view> lines = split_lines(text);
  CsvTable table;
  std::size_t n = 0;
  while (n < lines.size() && (trim(lines[n]).empty() || trim(lines[n]).starts_with('#'))) ++n;
  if (n == lines.size()) throw ReadError(path, 0, "there is no header row");
  const std::string_view head = lines[n];
  table.header_line = n + 1;
  const auto count = [&](char c) { return std::count(head.begin(), head.end(), c); };
  table.separator = count(';') > 0 && count(';') >= count(',') ? ';'
                    : count('\t') > count(',')                 ? '\t'
                                                               : ',';
  table.names = csv_cells(head, table.separator);
  while (!table.names.empty() && table.names.back().empty()) table.names.pop_back();
  for (++n; n < lines.size(); ++n) {
    if (trim(lines[n]).empty() || trim(lines[n]).starts_with('#')) continue;
    std::vector<std::string> cells = csv_cells(lines[n], table.separator);
    while (cells.size() > table.names.size() && cells.back().empty()) cells.pop_back();
    if (cells.size() != table.names.size()) {
      throw ReadError(path, n + 1,
                      fmt::format("expected {} cells as in the header ({}), found {}",
                                  table.names.size(), fmt::join(table.names, ", "), cells.size()));
    }
    table.rows.push_back(std::move(cells));
    table.lines.push_back(n + 1);
  }
  table.last_row_has_end =
      table.rows.empty() || table.lines.back() < lines.size() || ends_with_line(text);
  return table;
}

CsvTable read_csv_table(const std::filesystem::path& path) {
  return parse_csv_table(read_text_file(path), path);
}

CsvSeries parse_csv_series(std::string_view text, const std::filesystem::path& path) {
  CsvTable table = parse_csv_table(text, path);
  CsvSeries series;
  if (!table.last_row_has_end && table.rows.size() == 1) {
    series.repairs.push_back({table.lines.back(), std::string(kLastRowKept)});
  } else if (!table.last_row_has_end) {
    series.repairs.push_back({table.lines.back(), std::string(kLastRowLeftOut)});
    table.rows.pop_back();
    table.lines.pop_back();
  }
  std::optional<std::size_t> time_column;
  double time_to_s = 1.0;
  std::vector<Channel> channels;
  std::vector<double> factor;
  std::vector<std::size_t> columns;
  std::vector<NamedUnit> labels;
  for (const std::string& name : table.names) labels.push_back(take_apart(name));
  const std::size_t first = take_units_row(table, labels) ? 1 : 0;
  for (std::size_t c = 0; c < labels.size(); ++c) {
    const NamedUnit& label = labels[c];
    if (!time_column && is_time(label.name)) {
      if (label.unit && label.unit->unit != Unit::second) {
        throw ReadError(path, table.header_line,
                        fmt::format("column '{}': time is in s or ms", table.names[c]));
      }
      time_column = c;
      time_to_s = label.unit                                   ? label.unit->to_si
                  : equal_ignoring_case(label.name, "time_ms") ? 1e-3
                                                               : 1.0;
      continue;
    }
    channels.push_back({label.name, label.unit ? label.unit->unit : Unit::dimensionless});
    factor.push_back(label.unit ? label.unit->to_si : 1.0);
    series.has_unit.push_back(label.unit.has_value());
    columns.push_back(c);
  }
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (channels[c].name.empty())
      throw ReadError(path, table.header_line,
                      fmt::format("column {} has no name", columns[c] + 1));
    for (std::size_t d = 0; d < c; ++d) {
      if (channels[c].name == channels[d].name) {
        throw ReadError(path, table.header_line,
                        fmt::format("two columns are named '{}'; rename one", channels[c].name));
      }
    }
  }
  if (!time_column) {
    throw ReadError(path, table.header_line,
                    fmt::format("no time column; expected one named time (in s) among {}",
                                fmt::join(table.names, ", ")));
  }
  if (table.rows.size() == first)
    throw ReadError(path, 0, "there are no rows of numbers after the header");
  Eigen::VectorXd time(static_cast<Eigen::Index>(table.rows.size() - first));
  Eigen::MatrixXd values(time.size(), static_cast<Eigen::Index>(columns.size()));
  std::size_t comma_line = 0;
  std::size_t gap_line = 0;
  const auto number = [&](const std::string& cell, std::size_t line, const std::string& name) {
    const auto value =
        cell.empty() ? std::optional(std::numeric_limits<double>::quiet_NaN()) : parse_number(cell);
    if (value && !std::isfinite(*value) && gap_line == 0) gap_line = line;
    if (value) return *value;
    if (table.separator != ',') {
      if (const auto mended = parse_comma_number(cell)) {
        if (comma_line == 0) comma_line = line;
        return *mended;
      }
    }
    throw ReadError(path, line,
                    fmt::format("column '{}': expected a number, found '{}'", name, cell));
  };
  for (std::size_t r = first; r < table.rows.size(); ++r) {
    const auto row = static_cast<Eigen::Index>(r - first);
    time[row] =
        time_to_s * number(table.rows[r][*time_column], table.lines[r], table.names[*time_column]);
    if (!std::isfinite(time[row])) throw ReadError(path, table.lines[r], "the time is missing");
    if (row > 0 && time[row] <= time[row - 1]) {
      throw ReadError(
          path, table.lines[r],
          fmt::format("time does not increase: {} s after {} s", time[row], time[row - 1]));
    }
    for (std::size_t k = 0; k < columns.size(); ++k) {
      values(row, static_cast<Eigen::Index>(k)) =
          factor[k] * number(table.rows[r][columns[k]], table.lines[r], table.names[columns[k]]);
    }
  }
  if (comma_line > 0)
    series.repairs.push_back({comma_line, "comma decimals read as decimal points"});
  if (gap_line > 0)
    series.repairs.push_back({gap_line, "a value is missing or no number; kept as a gap"});
  series.data = TimeSeries(std::move(time), std::move(channels), std::move(values));
  return series;
}

CsvSeries read_csv_series(const std::filesystem::path& path) {
  return parse_csv_series(read_text_file(path), path);
}

}  // namespace myoid::recording
