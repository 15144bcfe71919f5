#include "myoid/recording/tables/table_layout.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/files/unique_names.h"

namespace myoid::recording {
namespace {

/// Reads the number at the beginning of a cell: "2000 Hz", "100.5".
std::optional<double> leading_number(std::string_view cell) {
  cell = trim(cell);
  const std::size_t end = std::min(cell.find_first_not_of("0123456789.,-"), cell.size());
  const std::string_view behind = trim(cell.substr(end));
  if (!behind.empty() && !equal_ignoring_case(behind, "hz")) return std::nullopt;
  const auto number = parse_number(cell.substr(0, end));
  return number ? number : parse_comma_number(cell.substr(0, end));
}

std::string_view without_colon(std::string_view cell) {
  cell = trim(cell);
  while (cell.ends_with(':')) cell = trim(cell.substr(0, cell.size() - 1));
  return cell;
}

bool is_row_of_numbers(std::string_view line, char separator) {
  const auto cells = cells_of(line, separator);
  return !cells.empty() && parse_number(cells[0]).has_value() && cells.size() > 1;
}

}  // namespace

std::size_t TableLayout::count(TableColumn::Kind kind) const {
  return static_cast<std::size_t>(std::ranges::count(columns, kind, &TableColumn::kind));
}

Clocks TableLayout::clocks() const {
  const std::size_t times = count(TableColumn::Kind::time);
  const bool rated = std::ranges::any_of(columns, [](const TableColumn& c) { return c.rate_hz > 0.0; });
  return times > 1 ? Clocks::of_time_columns : times == 0 && rated ? Clocks::of_rates : Clocks::of_rows;
}

void TableLayout::read_header(const TableText& text, std::size_t end, const HeaderWords& words) {
  rate_hz = stated_number(text, end, separator, words.rate).value_or(0.0);
  rows_said = stated_number(text, end, separator, words.rows);
  channels_said = stated_number(text, end, separator, words.channels);
}

void TableLayout::set_rows_below(const TableText& text, std::size_t names, char between) {
  separator = between;
  names_line = names;
  first_row = names + 1;
  end_row = end_of_block(text, first_row, separator);
}

TableRows rows_of(const TableLayout& layout) {
  TableRows rows{.separator = layout.separator,
                 .first = layout.first_row,
                 .end = layout.end_row,
                 .short_row = layout.short_row,
                 .state_gaps = layout.short_row == ShortRow::refused,
                 .rows_said = layout.rows_said};
  for (std::size_t c = 0; c < layout.columns.size(); ++c) {
    const TableColumn& column = layout.columns[c];
    rows.names.push_back(column.name);
    switch (column.kind) {
      case TableColumn::Kind::channel:
        if (rows.values.empty()) rows.first_triple = c;
        rows.values.push_back(c);
        break;
      case TableColumn::Kind::time:
      case TableColumn::Kind::frame:
      case TableColumn::Kind::sub_frame:
        rows.clock.push_back(c);
        break;
      case TableColumn::Kind::remark:
        rows.texts.push_back(c);
        break;
      case TableColumn::Kind::left_out:
        break;
    }
  }
  rows.empty_row_is_gap = rows.clock.empty();
  return rows;
}

std::size_t end_of_block(const TableText& text, std::size_t first, char separator) {
  std::size_t n = first;
  while (n < text.lines.size()) {
    if (!has_no_cell(text.lines[n], separator)) {
      ++n;
      continue;
    }
    std::size_t next = n;
    while (next < text.lines.size() && has_no_cell(text.lines[next], separator)) ++next;
    // The rate of a new section stands alone in its row; rows of the same table have more cells.
    if (next == text.lines.size() || !is_row_of_numbers(text.lines[next], separator)) return n;
    n = next;
  }
  return n;
}

std::optional<double> stated_number(const TableText& text,
                                    std::size_t end,
                                    char separator,
                                    const std::vector<std::string_view>& words) {
  const auto is_word = [&](std::string_view cell) {
    return std::ranges::any_of(words,
                               [&](std::string_view word) { return equal_ignoring_case(without_colon(cell), word); });
  };
  end = std::min(end, text.lines.size());
  for (std::size_t n = 0; n < end; ++n) {
    const auto cells = cells_of(text.lines[n], separator);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (const std::size_t colon = cells[c].find(':'); colon != std::string::npos) {
        const auto number = leading_number(std::string_view(cells[c]).substr(colon + 1));
        if (number && is_word(std::string_view(cells[c]).substr(0, colon))) return number;
      }
      if (!is_word(cells[c])) continue;
      if (c + 1 < cells.size()) {
        if (const auto number = leading_number(cells[c + 1])) return number;
      }
      const auto below = n + 1 < end ? cells_of(text.lines[n + 1], separator) : std::vector<std::string>();
      if (cells.size() > 2 && c < below.size()) {
        if (const auto number = leading_number(below[c])) return number;
      }
    }
  }
  return std::nullopt;
}

std::string stated_text(const TableText& text, std::size_t end, char separator, std::string_view word) {
  for (std::size_t n = 0; n < std::min(end, text.lines.size()); ++n) {
    const auto cells = cells_of(text.lines[n], separator);
    for (std::size_t c = 0; c + 1 < cells.size(); ++c) {
      if (equal_ignoring_case(without_colon(cells[c]), word)) return cells[c + 1];
    }
  }
  return "";
}

std::vector<std::string> unique_names(const std::vector<std::string>& names,
                                      std::string_view kind,
                                      std::size_t line,
                                      std::vector<Repair>& repairs) {
  std::vector<std::string> result;
  UniqueNames unique(names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string base = names[i];
    if (base.empty()) {
      base = fmt::format("{}_{}", kind, i + 1);
      while (unique.lists(base)) base += "_";
      repairs.push_back({line, fmt::format("{} {} has no name; it is '{}' here", kind, i + 1, base)});
    }
    std::string name = unique.take(base);
    if (name != base)
      repairs.push_back({line, fmt::format("two {}s are named '{}'; the later one is '{}' here", kind, base, name)});
    result.push_back(std::move(name));
  }
  return result;
}

std::string lower(std::string_view text) {
  std::string word(text);
  for (char& c : word) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return word;
}

}  // namespace myoid::recording
