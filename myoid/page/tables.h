#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/page/report.h"

namespace myoid::page {

/// Returns the table as comma-separated values (RFC 4180: CRLF is not used, quotes where needed); a
/// row of column names first. Badges are left out.
[[nodiscard]] std::string table_csv(const Table& table);
/// Returns one row of it, with the end of the line.
[[nodiscard]] std::string csv_line(const std::vector<std::string>& cells);

/// Returns the table for a terminal: the title, then the columns side by side, a line a row. Reasons (a column "why"),
/// captions, badges and hints are left out; a long cell ends in an ellipsis.
[[nodiscard]] std::string table_text(const Table& table);

/// Returns a table's row of plain texts.
[[nodiscard]] std::vector<Cell> text_row(std::vector<std::string> texts);

/// Returns the samples of a figure, in full and not decimated: one row per sample, columns
/// panel,series,role,x,y and, where a series has them, y_lower,y_upper. Gaps are empty cells.
[[nodiscard]] std::string figure_csv(const Figure& figure);

/// Returns the word for the role in files: "reference", "literature", ...
[[nodiscard]] std::string_view name(Role role);
[[nodiscard]] std::string_view name(Badge badge);
[[nodiscard]] std::string_view name(GateStatus status);
/// Returns "passed", "caution", "failed" or "note", as a page says it.
[[nodiscard]] std::string_view spelled(GateStatus status);

}  // namespace myoid::page
