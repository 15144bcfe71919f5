#pragma once

#include <filesystem>
#include <string>

#include "myoid/files/marker_series.h"

namespace myoid::recording {

/// Text of a .trc file exactly as OpenSim 4 reads it, in millimeters; gaps are empty cells.
/// `file_name` stands in its first line. Throws InvalidInput if there is no frame or no marker, or
/// a name holds a blank.
[[nodiscard]] std::string format_trc(const MarkerSeries& markers, const std::string& file_name);

/// Writes it, whole or not at all.
void write_trc(const std::filesystem::path& path, const MarkerSeries& markers);

}  // namespace myoid::recording
