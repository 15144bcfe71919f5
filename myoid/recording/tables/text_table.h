#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/ground/files/text_file.h"

namespace myoid::recording {

/// The lines of a text that holds a table. Lines of the header that a cell in quotes spans are one; empty lines follow
/// it in their place.
struct TableText {
  explicit TableText(std::string_view text);

  std::vector<std::string_view> lines;
  bool ends_with_line;  ///< False: the text ends in the middle of its last line.
};

/// Returns the next cell as written and moves `at` to the separator behind it, or to the end.
[[nodiscard]] std::string_view next_cell(const char*& at, const char* end, char separator);

/// Splits a line into cells. Blanks and quotes around cells are dropped, "" inside quotes reads as
/// one quote, bytes that are no UTF-8 read as Latin-1. Separators inside quotes do not count.
[[nodiscard]] std::vector<std::string> cells_of(std::string_view line, char separator);

/// Returns the cells of a line without the empty ones at its end.
[[nodiscard]] std::vector<std::string> filled_cells(std::string_view line, char separator);

/// Returns true for a cell that says "not a number": "-", "****", "n/a", "nan", "#DIV/0!".
[[nodiscard]] bool is_gap_word(std::string_view cell);

[[nodiscard]] constexpr bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Returns true for a line that holds only separators and blanks.
[[nodiscard]] bool has_no_cell(std::string_view line, char separator);

/// Returns true for a line without a cell and for a line of dashes between header and rows.
[[nodiscard]] bool is_rule(std::string_view line);

/// Throws ReadError for a text that is no table but has the ending of one: a .mot or .sto file that a spreadsheet saved
/// (a line `endheader`), an ASCII export of Vicon Workstation (sections TRAJECTORIES, ANALOG), a text of Spike2.
void refuse_other_kinds(const TableText& text, const std::filesystem::path& path);

/// The last row of a text that ends without a line end.
struct LastRow {
  bool kept = false;
  Repair note;
};

/// Decides whether a last row without a line end is complete. It is kept, with a note, if it is the only row, or if it
/// has all cells (`whole`) and its last number is not shorter than in all of the rows above. Otherwise it is left out.
[[nodiscard]] LastRow last_row_without_end(const TableText& text, bool whole, bool only_row);

/// Notes where the header's number of columns, channels, markers or rows differs from the number found. Fewer rows or
/// frames than stated are lost.
void compare_count(std::optional<double> said,
                   std::size_t found,
                   std::string_view kind,
                   std::vector<Repair>& repairs,
                   std::size_t line = 0);

}  // namespace myoid::recording
