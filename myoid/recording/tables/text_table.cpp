#include "myoid/recording/tables/text_table.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_words.h"

namespace myoid::recording {
namespace {

std::string unquoted(std::string_view cell) {
  if (cell.find('"') == std::string_view::npos) return to_utf8(cell);
  std::string text;
  bool quoted = false;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    if (cell[i] != '"') {
      text += cell[i];
    } else if (quoted && i + 1 < cell.size() && cell[i + 1] == '"') {
      text += cell[++i];
    } else {
      quoted = !quoted;
    }
  }
  return to_utf8(trim(text));
}

/// Joins the lines of the header that a cell in quotes spans. Its first quote stands at the begin of a cell.
void join_quoted_lines(std::vector<std::string_view>& lines) {
  constexpr std::size_t kHeader = 50, kMost = 5;
  const auto odd = [](std::string_view line) { return std::ranges::count(line, '"') % 2 == 1; };
  for (std::size_t n = 0; n < std::min(lines.size(), kHeader); ++n) {
    if (!odd(lines[n])) continue;
    const std::size_t quote = lines[n].rfind('"');
    if (quote > 0 && std::string_view(",;\t ").find(lines[n][quote - 1]) == std::string_view::npos) continue;
    std::size_t last = n + 1;
    while (last < lines.size() && last <= n + kMost && !odd(lines[last])) ++last;
    if (last >= lines.size() || last > n + kMost) continue;
    const char* const end = lines[last].data() + lines[last].size();
    lines[n] = {lines[n].data(), static_cast<std::size_t>(end - lines[n].data())};
    for (; last > n; --last) lines[last] = {};
  }
}

}  // namespace

TableText::TableText(std::string_view text) : lines(split_lines(text)), ends_with_line(ground::ends_with_line(text)) {
  join_quoted_lines(lines);
}

bool is_gap_word(std::string_view cell) {
  static constexpr std::array<std::string_view, 18> kWords{
      "n/a",       "nan",  "na",    "#n/a",    "null",    "none",   "missing", "-1.#ind", "1.#qnan",
      "-nan(ind)", "-nan", "#num!", "#div/0!", "#value!", "#wert!", "#nv",     "ovr",     "?"};
  const bool marks = !cell.empty() && (cell.find_first_not_of('-') == std::string_view::npos ||
                                       cell.find_first_not_of('*') == std::string_view::npos);
  return marks || cell == "." ||
         std::ranges::any_of(kWords, [&](std::string_view word) { return equal_ignoring_case(cell, word); });
}

std::string_view next_cell(const char*& at, const char* end, char separator) {
  const char* const begin = at;
  bool quoted = false;
  for (; at != end && (quoted || *at != separator); ++at) quoted = quoted != (*at == '"');
  return trim({begin, static_cast<std::size_t>(at - begin)});
}

std::vector<std::string> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells;
  const char* at = line.data();
  const char* const end = at + line.size();
  for (;; ++at) {
    cells.push_back(unquoted(next_cell(at, end, separator)));
    if (at == end) return cells;
  }
}

std::vector<std::string> filled_cells(std::string_view line, char separator) {
  std::vector<std::string> cells = cells_of(line, separator);
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
  return cells;
}

bool has_no_cell(std::string_view line, char separator) {
  return std::ranges::all_of(line,
                             [&](char c) { return c == separator || c == ' ' || c == '\t' || c == '\r' || c == '"'; });
}

void refuse_other_kinds(const TableText& text, const std::filesystem::path& path) {
  constexpr std::size_t kHeader = 2000;
  for (std::size_t n = 0; n < std::min(text.lines.size(), kHeader); ++n) {
    std::string_view line = text.lines[n];
    if (line.size() > 2000) continue;
    while (!line.empty() && std::string_view(",;\t \r\"").find(line.back()) != std::string_view::npos)
      line.remove_suffix(1);
    line = trim(line);
    while (line.starts_with('"')) line.remove_prefix(1);
    if (equal_ignoring_case(line, "endheader"))
      throw ReadError(
          path, n + 1,
          "this is a storage file (.mot, .sto) under another name: its header, which says whether angles are "
          "in degrees, ends here; give it a name that ends in .mot or .sto");
    if (n == 0 && equal_ignoring_case(line, "INFORMATION"))
      throw ReadError(
          path, 1,
          "this is a text of Spike2, whose channels stand one below another; export it as spreadsheet text, "
          "with a column of times");
    if (line == "TRAJECTORIES" || line == "ANALOG" || line == "MODEL OUTPUTS")
      throw ReadError(
          path, n + 1,
          "this is an ASCII export of Vicon Workstation or Polygon (section '{}'), which is not read; export "
          "the trial as .c3d",
          line);
  }
}

bool is_rule(std::string_view line) { return line.find_first_not_of(" \t\r,;-=_\"") == std::string_view::npos; }

LastRow last_row_without_end(const TableText& text, bool whole, bool only_row) {
  const std::size_t line = text.lines.size();
  // Where the number of decimals varies from row to row, a row with fewer of them is none that is cut off.
  constexpr std::size_t kRows = 100;
  bool shorter = true;
  for (std::size_t n = line; shorter && n > 1 && n + kRows > line; --n) {
    const std::string_view above = trim(text.lines[n - 2]);
    const std::size_t cell = above.find_last_of("\t; ");
    const std::string_view number = cell == std::string_view::npos ? above : above.substr(cell + 1);
    if (!parse_number(number.substr(number.find_last_of(',') + 1))) break;
    shorter = looks_cut(text.lines[line - 1], above);
  }
  const bool complete = whole && line > 1 && !shorter;
  const bool kept = only_row || complete;
  return {kept, {.line = line, .message = std::string(kept ? kLastRowKept : kLastRowLeftOut), .lost = !kept}};
}

void compare_count(std::optional<double> said,
                   std::size_t found,
                   std::string_view kind,
                   std::vector<Repair>& repairs,
                   std::size_t line) {
  if (!said || *said == static_cast<double>(found)) return;
  const bool lost = (kind == "rows" || kind == "frames") && *said > static_cast<double>(found);
  // A large loss stands before that of the last row.
  repairs.insert(
      lost ? repairs.begin() : repairs.end(),
      {.line = line, .message = fmt::format("the header says {} {}, there are {}", *said, kind, found), .lost = lost});
}

}  // namespace myoid::recording
