#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::recording {

struct AncFile {
  TimeSeries data;  ///< Volts at the board's input; the file does not state earlier amplification.
  std::vector<Repair> repairs;
};

/// Reads an .anc file (analog channels as text). A count c of a board of b bits and range ±R mV means
///
///   V = c · 2 R / (2^b − 1) / 1000,
///
/// the scale that the maker's own C3D files have. Repairs with a note: counts of channels that disagree, repeated
/// names, a last row that is cut off, rates that differ from the times. Throws ReadError with the line where a cell is
/// no number, time goes backwards, or the header has no names, ranges or bits.
[[nodiscard]] AncFile read_anc(const std::filesystem::path& path);
[[nodiscard]] AncFile parse_anc(std::string_view text, const std::filesystem::path& path);

}  // namespace myoid::recording
