#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/ground/files/text_file.h"
#include "myoid/recording/tables/table_series.h"

namespace myoid::recording {

/// A table of text cells with a header row.
struct CsvTable {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> lines;  ///< Line number of each row.
  std::size_t header_line = 0;
  char separator = ',';
  bool last_row_has_end = true;  ///< False: the file ends in the middle of its last row.
};

/// Reads a table. The header row decides the separator (comma, semicolon or tab); quotes follow RFC 4180; blanks around
/// cells are dropped. Throws ReadError if a row has another number of cells than the header.
[[nodiscard]] CsvTable read_csv_table(const std::filesystem::path& path);
[[nodiscard]] CsvTable parse_csv_table(std::string_view text, const std::filesystem::path& path);

/// Returns the first line, from `n` on, that is neither blank nor a remark.
[[nodiscard]] std::size_t next_line(const TableText& text, std::size_t n);

/// Returns true for the names of the time column in such tables, whatever the case: "time", "t", "time_ms", ...
[[nodiscard]] bool names_plain_time(std::string_view name);

/// Reads a table with a time column (`time`, `Time [s]`, `t`, `time (ms)`, ...) as a series. Decimal commas are read
/// where a semicolon or tab separates; an empty cell is a gap. Throws ReadError if there is no time column, a cell is
/// no number, time does not increase, two columns share a name, or the time's unit is unknown.
[[nodiscard]] CsvSeries read_csv_series(const std::filesystem::path& path);
[[nodiscard]] CsvSeries parse_csv_series(std::string_view text, const std::filesystem::path& path);

/// Leaves out, with their names, the channels that hold a text or a written time in each of the first rows, and a
/// column without a name that counts the rows.
void leave_out_texts_and_counts(const TableText& text, TableLayout& layout);

}  // namespace myoid::recording
