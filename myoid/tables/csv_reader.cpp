#include "myoid/tables/csv_reader.h"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/tables/channel_labels.h"

namespace myoid::recording {
namespace {

using Kind = TableColumn::Kind;

/// Finds the first line, from `n` on, that is neither blank nor a remark.
std::size_t next_line(const TableText& text, std::size_t n) {
  while (n < text.lines.size() && (trim(text.lines[n]).empty() || trim(text.lines[n]).starts_with('#'))) ++n;
  return n;
}

/// Returns the separator of a header row.
char separator_of(std::string_view head) {
  const auto count = [&](char c) { return std::count(head.begin(), head.end(), c); };
  return count(';') > 0 && count(';') >= count(',') ? ';' : count('\t') > count(',') ? '\t' : ',';
}

bool is_time(std::string_view name) {
  return equal_ignoring_case(name, "time") || equal_ignoring_case(name, "t") || equal_ignoring_case(name, "time_s") ||
         equal_ignoring_case(name, "times") || equal_ignoring_case(name, "time_ms");
}

/// Splits "name [unit]" or "name (unit)".
TableColumn take_apart(const std::string& label) {
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const std::size_t begin = label.rfind(open);
    const std::size_t end = label.rfind(close);
    if (begin == std::string::npos || end == std::string::npos || end < begin) continue;
    if (auto unit = parse_unit(std::string_view(label).substr(begin + 1, end - begin - 1)))
      return {Kind::channel, std::string(trim(std::string_view(label).substr(0, begin))), unit};
  }
  return {Kind::channel, label};
}

/// Reads a row of units ("s", "mV", ...) for the columns that have none; false if the row holds numbers.
bool take_units_row(const std::vector<std::string>& cells, std::vector<TableColumn>& columns) {
  bool any = false;
  for (const std::string& cell : cells) {
    if (cell.empty()) continue;
    if (parse_number(cell) || !unit_in_cell(cell)) return false;
    any = true;
  }
  for (std::size_t c = 0; any && c < std::min(columns.size(), cells.size()); ++c) {
    if (!columns[c].unit && !cells[c].empty()) columns[c].unit = unit_in_cell(cells[c]);
  }
  return any;
}

/// Returns the layout of a header row with a time column and rows of numbers below.
TableLayout plain_layout(const TableText& text, const std::filesystem::path& path) {
  TableLayout layout;
  layout.plain = true;
  const std::size_t head = next_line(text, 0);
  if (head == text.lines.size()) throw ReadError(path, 0, "there is no header row");
  layout.separator = separator_of(text.lines[head]);
  layout.names_line = head;
  std::vector<std::string> names = cells_of(text.lines[head], layout.separator);
  while (!names.empty() && names.back().empty()) names.pop_back();
  for (const std::string& name : names) layout.columns.push_back(take_apart(name));
  layout.first_row = next_line(text, head + 1);
  layout.end_row = text.lines.size();
  if (layout.first_row < text.lines.size() &&
      take_units_row(cells_of(text.lines[layout.first_row], layout.separator), layout.columns))
    ++layout.first_row;
  const auto time =
      std::find_if(layout.columns.begin(), layout.columns.end(), [](const TableColumn& c) { return is_time(c.name); });
  if (time == layout.columns.end()) {
    throw ReadError(path, head + 1,
                    fmt::format("no time column; expected one named time (in s) among {}", fmt::join(names, ", ")));
  }
  if (time->unit && time->unit->unit != Unit::second)
    throw ReadError(
        path, head + 1,
        fmt::format("column '{}': time is in s or ms", names[static_cast<std::size_t>(time - layout.columns.begin())]));
  if (!time->unit && equal_ignoring_case(time->name, "time_ms")) time->unit = parse_unit("ms");
  time->kind = Kind::time;
  return layout;
}

}  // namespace

CsvTable parse_csv_table(std::string_view text, const std::filesystem::path& path) {
  const TableText whole(text);
  CsvTable table;
  std::size_t n = next_line(whole, 0);
  if (n == whole.lines.size()) throw ReadError(path, 0, "there is no header row");
  table.header_line = n + 1;
  table.separator = separator_of(whole.lines[n]);
  table.names = cells_of(whole.lines[n], table.separator);
  while (!table.names.empty() && table.names.back().empty()) table.names.pop_back();
  while ((n = next_line(whole, n + 1)) < whole.lines.size()) {
    std::vector<std::string> cells = cells_of(whole.lines[n], table.separator);
    while (cells.size() > table.names.size() && cells.back().empty()) cells.pop_back();
    if (cells.size() != table.names.size()) {
      const bool too_many = cells.size() > table.names.size() && table.separator == ',';
      throw ReadError(
          path, n + 1,
          fmt::format("expected {} cells as in the header ({}), found {}{}", table.names.size(),
                      fmt::join(table.names, ", "), cells.size(),
                      too_many ? "; a cell too many, or decimal commas in a table separated by commas" : ""));
    }
    table.rows.push_back(std::move(cells));
    table.lines.push_back(n + 1);
  }
  table.last_row_has_end = table.rows.empty() || table.lines.back() < whole.lines.size() || whole.ends_with_line;
  return table;
}

CsvTable read_csv_table(const std::filesystem::path& path) { return parse_csv_table(read_text_file(path), path); }

CsvSeries parse_csv_series(std::string_view text, const std::filesystem::path& path) {
  const TableText table(text);
  return channels_of_table(table, plain_layout(table, path), path);
}

CsvSeries read_csv_series(const std::filesystem::path& path) { return parse_csv_series(read_text_file(path), path); }

}  // namespace myoid::recording
