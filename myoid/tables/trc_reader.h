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
  double rate_hz = 0.0;  ///< Stated by the header, else 0.
  std::string unit;      ///< As written in the file; positions here are in meters.
  std::vector<Repair> repairs;
};

/// Reads a .trc file. The Time column counts, not the stated rate. An empty cell, NaN or exactly 0 0 0 is a missing
/// marker. Repairs with a note: CRLF, missing blank line, surplus tabs, `Times`, seven header keys, numbering from X0,
/// no line X1 Y1 Z1, comma separation, decimal commas, counts that disagree with the rows, rows that end early, a last
/// row that is cut off, a repeated time, markers that share a name, markers without a name (`marker_3` by its place).
/// Throws ReadError with the line for an unknown unit, a cell that is no number, time that goes backwards, no marker,
/// no row.
[[nodiscard]] TrcFile read_trc(const std::filesystem::path& path);
[[nodiscard]] TrcFile parse_trc(std::string_view text, const std::filesystem::path& path);

}  // namespace myoid::recording
