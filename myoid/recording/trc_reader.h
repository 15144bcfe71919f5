#pragma once

#include <filesystem>
#include <string_view>

#include "myoid/recording/tables/marker_file.h"

namespace myoid::recording {

/// Reads a .trc file. The Time column counts, not the stated rate. An empty cell, NaN or exactly 0 0 0 is a missing
/// marker. Repairs with a note: CRLF, missing blank line, surplus tabs, `Times`, seven header keys, numbering from X0,
/// no line X1 Y1 Z1, comma separation, decimal commas, counts that disagree with the rows, rows that end early, a last
/// row that is cut off, a repeated time, markers that share a name, markers without a name (`marker_3` by its place).
/// Throws ReadError with the line for an unknown unit, a cell that is no number, time that goes backwards, no marker,
/// no row.
[[nodiscard]] MarkerFile read_trc(const std::filesystem::path& path);
[[nodiscard]] MarkerFile parse_trc(std::string_view text, const std::filesystem::path& path);

}  // namespace myoid::recording
