#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/core/units.h"

/// Where a table of channels stands in the text that an EMG program wrote, and what it says of
/// them.
namespace myoid::recording::emg_table {

struct Label {
  std::string name;
  std::optional<ScaledUnit> unit;
};

struct Layout {
  char separator = ',';
  std::size_t first_row = 0;  ///< Of numbers.
  std::size_t names_row = 0;
  std::vector<Label> labels;
  std::optional<double> rate_hz;
};

/// The table whose rows of numbers, cells separated by `separator`, come first: its names are the
/// line above them, perhaps with a row of units or rates between. Empty if there is none.
[[nodiscard]] std::optional<Layout> find_table(const std::vector<std::string_view>& lines,
                                               char separator);

/// The first line that is no remark is the header, with one time column and no other line of text
/// below.
[[nodiscard]] bool is_plain(const std::vector<std::string_view>& lines, const Layout& layout);

/// Which columns are times. A second one called just "t" or "T" is a channel (a trigger, a torque),
/// unless the first has the same name.
[[nodiscard]] std::vector<bool> time_columns_of(const std::vector<Label>& labels);

/// A column of frame or sample numbers, by its name.
[[nodiscard]] bool is_counter(const std::string& name);

/// Cells of a row; separators inside quotes do not count.
[[nodiscard]] std::vector<std::string> cells_of(std::string_view line, char separator);

/// A number, with a decimal comma where the comma does not separate.
[[nodiscard]] std::optional<double> cell_number(std::string_view cell, char separator);

/// A row of nothing but numbers and empty cells, at least one of the former.
[[nodiscard]] bool is_numbers(const std::vector<std::string>& cells, char separator);

/// In small letters (ASCII).
[[nodiscard]] std::string lower(std::string_view text);

}  // namespace myoid::recording::emg_table
