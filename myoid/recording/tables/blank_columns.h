#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/recording/tables/text_table.h"

namespace myoid::recording {

/// The note on such a table.
inline constexpr std::string_view kBlanksSeparate = "blanks separate the columns";

/// Returns the text of a table whose columns are separated by runs of blanks with a tab in place of each run, line by
/// line. The names above the numbers are separated by two blanks or more ("POS (ANAT)   VELOCITY") or by one. A row of
/// units that has fewer cells than there are columns stands below the names by its place in the line. Empty for other
/// texts: those with another separator, and those without two rows of as many numbers below each other.
[[nodiscard]] std::optional<std::string> tabs_for_blanks(const TableText& text);

/// Splits a line at runs of two blanks or more.
[[nodiscard]] std::vector<std::string_view> wide_cells(std::string_view line);

}  // namespace myoid::recording
