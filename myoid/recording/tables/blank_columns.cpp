#include "myoid/recording/tables/blank_columns.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "myoid/recording/tables/channel_labels.h"

namespace myoid::recording {
namespace {

using Words = std::vector<std::string_view>;

/// Returns the numbers of a row that holds at least two and nothing else, without a tab or a semicolon.
std::size_t numbers_between_blanks(std::string_view line) {
  if (line.find_first_of("\t;") != std::string_view::npos) return 0;
  const Words words = split_words(line);
  const bool all = std::ranges::all_of(words, [](std::string_view word) {
    return parse_number(word).has_value() || parse_comma_number(word).has_value() || equal_ignoring_case(word, "nan");
  });
  return all && words.size() > 1 ? words.size() : 0;
}

/// Returns the words of a line; a unit in brackets belongs to the word before it ("Torque (Nm)").
Words words_with_units(std::string_view line) {
  Words cells;
  for (const std::string_view word : split_words(line)) {
    if (cells.empty() || !(word.starts_with('(') || word.starts_with('['))) {
      cells.push_back(word);
    } else {
      const char* const begin = cells.back().data();
      cells.back() = {begin, static_cast<std::size_t>(word.data() + word.size() - begin)};
    }
  }
  return cells;
}

/// Returns the cells of a header line if they are as many as the columns. A mark of comments may stand before them.
Words header_cells(std::string_view line, std::size_t columns) {
  const std::size_t begin = line.find_first_not_of("#%/ \t");
  for (const std::string_view text : {line, line.substr(std::min(begin, line.size()))}) {
    for (Words& cells : std::array{wide_cells(text), split_words(text), words_with_units(text)})
      if (cells.size() == columns) return std::move(cells);
  }
  return {};
}

/// Puts each cell of a row into the column whose name stands nearest above it; empty if two are in one column.
Words under_names(const Words& names, std::string_view names_line, std::string_view line) {
  const auto middle = [](std::string_view cell, std::string_view in) {
    return static_cast<double>(cell.data() - in.data()) + 0.5 * static_cast<double>(cell.size());
  };
  Words row(names.size());
  for (const std::string_view cell : wide_cells(line)) {
    const double at = middle(cell, line);
    const auto nearest = std::ranges::min_element(names, {}, [&](std::string_view name) {
      const double off = middle(name, names_line) - at;
      return off < 0.0 ? -off : off;
    });
    std::string_view& place = row[static_cast<std::size_t>(nearest - names.begin())];
    if (!place.empty()) return {};
    place = cell;
  }
  return row;
}

void append(std::string& text, const Words& cells) {
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (c > 0) text += '\t';
    text += cells[c];
  }
}

/// The rows of the header that hold names and perhaps units.
struct HeaderRows {
  std::size_t names_line = 0, units_line = 0;  ///< Equal: there is no row of units.
  Words names, units;
};

std::optional<HeaderRows> header_rows(const TableText& text, std::size_t first, std::size_t columns) {
  std::size_t near = first;
  const auto line_above = [&](std::size_t n) {
    while (n > 0 && is_rule(text.lines[n - 1])) --n;
    return n == 0 ? text.lines.size() : n - 1;
  };
  near = line_above(first);
  if (near == text.lines.size()) return std::nullopt;
  HeaderRows rows{near, near, header_cells(text.lines[near], columns), {}};
  const std::size_t far = line_above(near);
  const bool units = rows.names.empty() || std::ranges::all_of(rows.names, [](std::string_view cell) {
                       return unit_in_cell(cell).has_value();
                     });
  if (units && far != text.lines.size()) {
    Words names = header_cells(text.lines[far], columns);
    Words below =
        rows.names.empty() && !names.empty() ? under_names(names, text.lines[far], text.lines[near]) : rows.names;
    if (!names.empty() && !below.empty()) rows = {far, near, std::move(names), std::move(below)};
  }
  if (rows.names.empty()) return std::nullopt;
  return rows;
}

}  // namespace

std::vector<std::string_view> wide_cells(std::string_view line) {
  std::vector<std::string_view> cells;
  line = trim(line);
  while (!line.empty()) {
    const std::size_t end = std::min(line.find("  "), line.size());
    cells.push_back(trim(line.substr(0, end)));
    line = trim(line.substr(end));
  }
  return cells;
}

std::optional<std::string> tabs_for_blanks(const TableText& text) {
  constexpr std::size_t kMost = 1000;
  std::size_t first = 1, columns = 0;
  for (; first < std::min(text.lines.size(), kMost); ++first) {
    columns = numbers_between_blanks(text.lines[first]);
    if (columns == 0) continue;
    const std::size_t next = first + 1;
    if (next >= text.lines.size() || numbers_between_blanks(text.lines[next]) == columns || !text.ends_with_line) break;
    columns = 0;
  }
  if (columns == 0) return std::nullopt;
  const auto header = header_rows(text, first, columns);
  if (!header) return std::nullopt;
  std::string tabs;
  for (std::size_t n = 0; n < text.lines.size(); ++n) {
    if (n == header->names_line) {
      append(tabs, header->names);
    } else if (n == header->units_line) {
      append(tabs, header->units);
    } else if (n < first) {
      tabs += text.lines[n];
    } else {
      append(tabs, split_words(text.lines[n]));
    }
    if (n + 1 < text.lines.size() || text.ends_with_line) tabs += '\n';
  }
  return tabs;
}

}  // namespace myoid::recording
