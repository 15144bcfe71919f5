#include "myoid/recording/tables/csv_reader.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/files/written_time.h"
#include "myoid/recording/tables/blank_columns.h"
#include "myoid/recording/tables/channel_labels.h"

namespace myoid::recording {
namespace {

using Kind = TableColumn::Kind;

char separator_of(std::string_view head) {
  std::string bare;  // without texts in quotes
  bool quoted = false;
  for (const char c : head) {
    quoted = quoted != (c == '"');
    if (!quoted) bare += c;
  }
  const auto count = [&](char c) { return std::ranges::count(bare, c); };
  return count(';') > 0 && count(';') >= count(',') ? ';' : count('\t') > count(',') ? '\t' : ',';
}

struct Head {
  std::size_t line = 0;  ///< Counted from 0.
  char separator = ',';
  std::vector<std::string> names;
};

Head head_of(const TableText& text, const std::filesystem::path& path) {
  refuse_other_kinds(text, path);
  const std::size_t line = next_line(text, 0);
  if (line == text.lines.size()) throw ReadError(path, 0, "there is no header row");
  const char separator = separator_of(text.lines[line]);
  return {line, separator, filled_cells(text.lines[line], separator)};
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
  const Head head = head_of(text, path);
  TableLayout layout;
  layout.plain = true;
  layout.separator = head.separator;
  layout.names_line = head.line;
  layout.columns = take_labels_apart(head.names);
  layout.first_row = next_line(text, head.line + 1);
  layout.end_row = text.lines.size();
  if (layout.first_row < text.lines.size() &&
      take_units_row(cells_of(text.lines[layout.first_row], layout.separator), layout.columns))
    ++layout.first_row;
  auto time = std::ranges::find_if(layout.columns, names_plain_time, &TableColumn::name);
  if (const auto clock = plain_clock(layout.columns); clock && names_plain_time(layout.columns[*clock].name))
    time = layout.columns.begin() + static_cast<std::ptrdiff_t>(*clock);
  if (time == layout.columns.end()) {
    throw ReadError(
        path, head.line + 1,
        fmt::format("no time column; expected one named time (in s) among {}", fmt::join(head.names, ", ")));
  }
  if (time->unit && time->unit->unit != Unit::second)
    throw ReadError(path, head.line + 1,
                    fmt::format("column '{}': time is in s or ms", head.names[at(time - layout.columns.begin())]));
  time->kind = Kind::time;
  leave_out_texts_and_counts(text, layout);
  return layout;
}

}  // namespace

void leave_out_texts_and_counts(const TableText& text, TableLayout& layout) {
  constexpr std::size_t kRows = 50;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t n = layout.first_row; rows.size() < kRows && n < text.lines.size(); n = next_line(text, n + 1))
    rows.push_back(cells_of(text.lines[n], layout.separator));
  if (rows.size() < 2) return;
  for (std::size_t c = 0; c < layout.columns.size(); ++c) {
    TableColumn& column = layout.columns[c];
    const auto number = [&](const std::vector<std::string>& row) {
      return c < row.size() ? parse_number(row[c]) : std::nullopt;
    };
    if (column.kind != Kind::channel) continue;
    const bool texts = std::ranges::all_of(rows, [&](const auto& row) {
      if (c >= row.size() || number(row) || is_gap_word(row[c])) return false;
      return std::ranges::any_of(row[c], is_letter) || written_time_s(row[c]).has_value();
    });
    const auto first = number(rows[0]), second = number(rows[1]);
    const bool counts = column.name.empty() && first && second && *second == *first + 1.0;
    if (!texts && !counts) continue;
    column.kind = Kind::left_out;
    if (counts) column.name = "(the count of the rows)";
  }
}

std::size_t next_line(const TableText& text, std::size_t n) {
  while (n < text.lines.size() && (trim(text.lines[n]).empty() || trim(text.lines[n]).starts_with('#'))) ++n;
  return n;
}

bool names_plain_time(std::string_view name) {
  return std::ranges::any_of(std::array{"time", "t", "time_s", "times", "time_ms"},
                             [&](const char* word) { return equal_ignoring_case(name, word); });
}

CsvTable parse_csv_table(std::string_view text, const std::filesystem::path& path) {
  const TableText whole(text);
  Head head = head_of(whole, path);
  CsvTable table;
  table.header_line = head.line + 1;
  table.separator = head.separator;
  table.names = std::move(head.names);
  std::size_t n = head.line;
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
  if (const auto tabs = tabs_for_blanks(table)) {
    const TableText columns(*tabs);
    CsvSeries series = channels_of_table(columns, plain_layout(columns, path), path);
    series.repairs.insert(series.repairs.begin(), {0, std::string(kBlanksSeparate)});
    return series;
  }
  return channels_of_table(table, plain_layout(table, path), path);
}

CsvSeries read_csv_series(const std::filesystem::path& path) { return parse_csv_series(read_text_file(path), path); }

}  // namespace myoid::recording
