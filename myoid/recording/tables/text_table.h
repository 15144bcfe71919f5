#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/files/text_file.h"

namespace myoid::recording {

/// The lines of a text that holds a table. Lines of the header that a cell in quotes spans are one; empty lines follow
/// it in their place.
struct TableText {
  explicit TableText(std::string_view text);

  std::vector<std::string_view> lines;
  bool ends_with_line;  ///< False: the text ends in the middle of its last line.
};

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

/// Meaning of a row with fewer cells than the header.
enum class ShortRow {
  refused,  ///< An error.
  gaps,     ///< Whole triples are missing at its end: these markers were not seen.
  ended,    ///< Its last channels have ended: no later row has more cells.
};

/// Places of the rows of numbers in a table, and the columns to read.
struct TableRows {
  char separator = ',';
  std::size_t first = 0, end = 0;     ///< Line numbers, counted from 0.
  std::vector<std::string> names{};   ///< Names of all columns: a row has as many cells.
  std::vector<std::size_t> clock{};   ///< Clock columns.
  std::vector<std::size_t> values{};  ///< Sample columns.
  std::vector<std::size_t> texts{};   ///< Remark columns; any row may have a remark.
  std::size_t first_triple = 0;       ///< Column of the first marker, for ShortRow::gaps.
  ShortRow short_row = ShortRow::refused;
  bool empty_row_is_gap = false;      ///< A row of separators is a frame without any marker.
  bool state_gaps = false;            ///< Notes the place of the first gap.
  std::optional<double> rows_said{};  ///< Number of rows that the header states.
};

struct TableRemark {
  std::size_t row = 0, column = 0;
  std::string text;
};

/// The rows as numbers: NaN where a cell is empty, "n/a", "-" or a word for "not a number".
struct TableNumbers {
  Eigen::MatrixXd clock, values;  ///< One column for each requested one.
  /// The number that stands for a missing value in each value column (`take_out_missing`).
  std::vector<std::optional<double>> missing;
  std::vector<std::size_t> lines;  ///< Line number of each row, counted from 1.
  std::vector<TableRemark> remarks;
  std::vector<Repair> repairs;
  bool day_times = false;  ///< The clock has times of the day.
};

/// Reads all rows. Decimal commas hold for the whole table: they are read where a semicolon or tab separates, and then
/// no number may have a point. Noted as repairs: decimal commas, blank lines between rows, gaps, rows that end early
/// where `short_row` allows it, a last row that is cut off (left out), a number of rows other than `rows_said`, times
/// of the day in a clock (`written_time_s`), which go on behind midnight, lines behind the samples whose clock is a
/// word
/// ("Mean"), a header that is repeated between rows. Throws ReadError with the line, found and
/// expected: a row wider or narrower than the header, a cell that is no number, points and decimal commas in one table,
/// no rows at all.
[[nodiscard]] TableNumbers read_rows(const TableText& text, const TableRows& rows, const std::filesystem::path& path);

}  // namespace myoid::recording
