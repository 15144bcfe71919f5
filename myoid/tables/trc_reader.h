#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/files/marker_series.h"
#include "myoid/files/text_file.h"

namespace myoid::recording {

struct TrcFile {
  MarkerSeries markers;
  double rate_hz = 0.0;  ///< As the header says; 0 if it does not.
  std::string unit;      ///< As written; positions are in meters here.
  std::vector<Repair> repairs;
};

/// Reads a .trc file. The Time column rules, not the rate. An empty cell, NaN or exactly 0 0 0 is a
/// missing marker. Mended with a note: CRLF, missing blank line, surplus tabs, `Times`, seven
/// header keys, numbering from X0, no line X1 Y1 Z1, comma separation, comma decimals, counts that
/// disagree with the rows, rows that end early, a last row that is cut off, a repeated time,
/// markers of one name, markers without
/// a name (`marker_3` by its place). Throws ReadError with the line for an unknown unit, a cell
/// that is no number, time that goes backwards, no marker, no row.
[[nodiscard]] TrcFile read_trc(const std::filesystem::path& path);
[[nodiscard]] TrcFile parse_trc(std::string_view text, const std::filesystem::path& path);

}  // namespace myoid::recording
