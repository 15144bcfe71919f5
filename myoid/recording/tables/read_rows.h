#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/files/text_file.h"
#include "myoid/recording/tables/text_table.h"

namespace myoid::recording {

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
