#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/core/units.h"
#include "myoid/tables/text_table.h"

namespace myoid::recording {

/// One column of a table: what its cells are.
struct TableColumn {
  enum class Kind {
    channel,    ///< Samples; of a table of markers a coordinate.
    time,       ///< Seconds, or `unit`: of all channels, or of those up to the next such column.
    frame,      ///< Number of the camera's frame, or of the sample.
    sub_frame,  ///< Number of the sample within its frame, from 0.
    remark,     ///< Text, where something happened.
    left_out,
  };
  Kind kind = Kind::channel;
  std::string name;
  std::optional<ScaledUnit> unit{};
  double rate_hz = 0.0;  ///< Of this channel alone, where the table states it; else 0.
};

/// A table as the rules of its maker describe it: where its rows stand, what its columns are, and
/// what its header says about them.
struct TableLayout {
  char separator = ',';
  std::size_t names_line = 0;              ///< Counted from 0.
  std::size_t first_row = 0, end_row = 0;  ///< Lines, counted from 0.
  std::vector<TableColumn> columns;        ///< Of all cells of a row.
  double rate_hz = 0.0;                    ///< Of the rows, where it is stated.
  double frame_rate_hz = 0.0;              ///< Of the cameras, where the rows are sub-frames.
  double first_frame = 1.0;                ///< Its time is 0.
  ShortRow short_row = ShortRow::refused;
  std::optional<double> rows_said;      ///< By the header.
  std::optional<double> channels_said;  ///< Channels or markers, by the header.
  std::optional<double> length_s;       ///< By the header.
  bool plain = false;  ///< A header row and numbers, no maker's format: each name stands once.
  std::vector<Repair> repairs;
};

/// Which cells of the rows are wanted.
[[nodiscard]] TableRows rows_of(const TableLayout& layout);

/// The line, from 0, that ends a block of rows which begins at `first`: a blank line that is not
/// followed by another row of numbers, or the end of the text.
[[nodiscard]] std::size_t end_of_block(const TableText& text, std::size_t first, char separator);

/// A number that a header states: in the cell behind a cell that is one of `words` (in small
/// letters, without a colon), in the same cell behind the word ("Sampling rate: 2000 Hz"), or in
/// the row below, where that holds values for a row of keys. Looks at the lines before `end`.
[[nodiscard]] std::optional<double> stated_number(const TableText& text,
                                                  std::size_t end,
                                                  char separator,
                                                  const std::vector<std::string_view>& words);

/// The text in the cell behind a cell that is `word`, in the lines before `end`; empty if there is
/// none.
[[nodiscard]] std::string stated_text(const TableText& text,
                                      std::size_t end,
                                      char separator,
                                      std::string_view word);

/// Names of which none is empty and none stands twice, and a note on each that was given.
[[nodiscard]] std::vector<std::string> unique_names(const std::vector<std::string>& names,
                                                    std::string_view kind,
                                                    std::size_t line,
                                                    std::vector<Repair>& repairs);

/// Says where the header's number of channels or markers is not the one found.
void compare_count(std::optional<double> said,
                   std::size_t found,
                   std::string_view kind,
                   std::vector<Repair>& repairs);

/// Without the capital letters of ASCII.
[[nodiscard]] std::string lower(std::string_view text);

}  // namespace myoid::recording
