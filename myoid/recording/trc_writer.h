#pragma once

#include <filesystem>
#include <string>

#include "myoid/ground/files/marker_series.h"

namespace myoid::recording {

/// Returns the text of a .trc file as OpenSim 4 reads it, in millimeters. Gaps are empty cells. `file_name` stands in
/// the first line. Throws InvalidInput if there is no frame or no marker, or if a name holds a blank.
[[nodiscard]] std::string format_trc(const MarkerSeries& markers, const std::string& file_name);

/// Writes this text to a file, completely or not at all.
void write_trc(const std::filesystem::path& path, const MarkerSeries& markers);

}  // namespace myoid::recording
