#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/files/text_file.h"

namespace myoid::recording {

/// The lines of a text that holds a table.
struct TableText {
  explicit TableText(std::string_view text)
      : lines(split_lines(text)), ends_with_line(recording::ends_with_line(text)) {}

  std::vector<std::string_view> lines;
  bool ends_with_line;  ///< False: the text stops inside its last line.
};

/// The cells of a line: blanks and quotes around them dropped, "" inside quotes read as one quote,
/// bytes that are no UTF-8 read as Latin-1. Separators inside quotes do not count.
[[nodiscard]] std::vector<std::string> cells_of(std::string_view line, char separator);

/// True for a line of nothing but separators and blanks.
[[nodiscard]] bool has_no_cell(std::string_view line, char separator);

/// The last row of a text that stops inside it.
struct LastRow {
  bool kept = false;
  Repair note;
};

/// Keeps the last row, with a note, if it is the only one, or if the header counts it (`counted`)
/// and its last number has as many decimals as the row above; else leaves it out.
[[nodiscard]] LastRow last_row_without_end(const TableText& text, bool counted, bool only_row);

/// What a row with fewer cells than the header is.
enum class ShortRow {
  refused,  ///< An error.
  gaps,     ///< Its last markers were not seen: whole triples are missing at its end.
  ended,    ///< Its last channels have ended: no later row has more cells.
};

/// Where the rows of numbers of a table stand, and which of their columns are wanted.
struct TableRows {
  char separator = ',';
  std::size_t first = 0, end = 0;   ///< Lines, counted from 0.
  std::vector<std::string> names;   ///< Of all columns: a row has as many cells.
  std::vector<std::size_t> clock;   ///< Columns that make the clock.
  std::vector<std::size_t> values;  ///< Columns of samples.
  std::vector<std::size_t> texts;   ///< Columns of remarks, which may stand in any row.
  std::size_t first_triple = 0;     ///< Column of the first marker, for ShortRow::gaps.
  ShortRow short_row = ShortRow::refused;
  bool empty_row_is_gap = false;    ///< A row of separators is a frame in which nothing was seen.
  bool state_gaps = false;          ///< A note says where the first one is.
  std::optional<double> rows_said;  ///< By the header.
};

struct TableRemark {
  std::size_t row = 0, column = 0;
  std::string text;
};

/// The rows as numbers: NaN where a cell is empty, "n/a", "-" or no number by its own word.
struct TableNumbers {
  Eigen::MatrixXd clock, values;   ///< A column for each that was asked for.
  std::vector<std::size_t> lines;  ///< Of each row, counted from 1.
  std::vector<TableRemark> remarks;
  std::vector<Repair> repairs;
};

/// Reads all rows. One decision holds for the whole table: decimal commas are read where ; or tab
/// separates, and then no number may have a point. Stated as a repair: decimal commas, blank lines
/// between rows, gaps, rows that end early where `short_row` allows it, a last row that is cut off
/// (left out), a number of rows that is not `rows_said`. Throws ReadError with the line, found and
/// expected: a row that is wider or narrower than the header, a cell that is no number, points
/// and decimal commas in one table, no rows at all.
[[nodiscard]] TableNumbers read_rows(const TableText& text,
                                     const TableRows& rows,
                                     const std::filesystem::path& path);

}  // namespace myoid::recording
