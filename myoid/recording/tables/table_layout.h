#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/ground/core/units.h"
#include "myoid/ground/files/event.h"
#include "myoid/recording/tables/read_rows.h"

namespace myoid::recording {

/// One column of a table and the kind of its cells.
struct TableColumn {
  enum class Kind {
    channel,    ///< Samples; in a table of markers a coordinate.
    time,       ///< Seconds, or `unit`: the clock of all channels, or of the channels up to the next
                ///< time column.
    frame,      ///< Number of the camera's frame or of the sample.
    sub_frame,  ///< Number of the sample within its frame, from 0.
    remark,     ///< Text about an event.
    left_out,
  };
  Kind kind = Kind::channel;
  std::string name;
  std::optional<ScaledUnit> unit{};
  double rate_hz = 0.0;  ///< The rate of this channel alone if the table states one, else 0.
};

/// Returns true for a column of the clock.
[[nodiscard]] constexpr bool is_clock(TableColumn::Kind kind) {
  return kind == TableColumn::Kind::time || kind == TableColumn::Kind::frame || kind == TableColumn::Kind::sub_frame;
}

/// The clocks of the channels: one of all rows, or one for each time column or stated rate.
enum class Clocks { of_rows, of_time_columns, of_rates };

/// Rows whose times begin anew.
struct RowBlock {
  std::size_t first_line = 0;  ///< Line of its first row, counted from 1.
  double begin_s = 0.0;        ///< To be added to the times of its rows.
};

/// The words of a header, in small letters, for the rate and for the numbers of rows and of channels.
struct HeaderWords {
  std::vector<std::string_view> rate, rows, channels;
};

/// The places of a table's rows, the kinds of its columns, and the statements of its header, as its
/// maker's rules define them.
struct TableLayout {
  char separator = ',';
  std::size_t names_line = 0;              ///< Line of the names, counted from 0.
  std::size_t first_row = 0, end_row = 0;  ///< Lines, counted from 0.
  std::vector<TableColumn> columns;        ///< All cells of a row.
  double rate_hz = 0.0;                    ///< Rate of the rows, if stated.
  double frame_rate_hz = 0.0;              ///< Rate of the cameras, if the rows are sub-frames.
  double first_frame = 1.0;                ///< The frame at time 0.
  ShortRow short_row = ShortRow::refused;
  std::optional<double> rows_said;      ///< Number of rows that the header states.
  std::optional<double> channels_said;  ///< Number of channels or markers that the header states.
  std::optional<double> length_s;       ///< Length that the header states.
  bool plain = false;                   ///< A header row and numbers in no maker's format: names must be unique.
  std::vector<RowBlock> blocks;         ///< Empty: one block.
  std::vector<Event> events;            ///< Events that stand outside of the columns.
  std::vector<Repair> repairs;

  [[nodiscard]] std::size_t count(TableColumn::Kind kind) const;
  [[nodiscard]] Clocks clocks() const;
  /// Reads rate and counts from the lines before `end`, each by the words for it (`stated_number`).
  void read_header(const TableText& text, std::size_t end, const HeaderWords& words);
  /// Sets the line of names, the separator and the block of rows below that line.
  void set_rows_below(const TableText& text, std::size_t names, char between);
};

/// Selects the cells that `read_rows` reads.
[[nodiscard]] TableRows rows_of(const TableLayout& layout);

/// Returns the line, from 0, at which the block of rows that begins at `first` ends: a blank line
/// with no row of numbers after it, or the end of the text.
[[nodiscard]] std::size_t end_of_block(const TableText& text, std::size_t first, char separator);

/// Returns a number that a header states about one of `words` (in small letters, without a colon). The number stands in
/// the next cell, in the same cell behind the word ("Sampling rate: 2000 Hz"), or in the row below, where that row
/// holds the values for a row of keys. Searches the lines before `end`.
[[nodiscard]] std::optional<double> stated_number(const TableText& text,
                                                  std::size_t end,
                                                  char separator,
                                                  const std::vector<std::string_view>& words);

/// Returns the text in the cell after a cell that equals `word`, in the lines before `end`; empty if there is none.
[[nodiscard]] std::string stated_text(const TableText& text, std::size_t end, char separator, std::string_view word);

/// Fills in empty names and changes repeated ones, with a note on each.
[[nodiscard]] std::vector<std::string> unique_names(const std::vector<std::string>& names,
                                                    std::string_view kind,
                                                    std::size_t line,
                                                    std::vector<Repair>& repairs);

/// Turns capital ASCII letters into small ones.
[[nodiscard]] std::string lower(std::string_view text);

}  // namespace myoid::recording
