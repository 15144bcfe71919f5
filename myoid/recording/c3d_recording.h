#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/recording/recording.h"

namespace myoid::recording {

/// Reads markers, channels, plates and events of a C3D file in SI. The bytes are converted part by
/// part, so that memory holds little more than the result. Throws ReadError.
[[nodiscard]] Recording read_c3d_recording(const std::filesystem::path& path);

/// Reads only the markers, and the unit as written; no markers if the file has no points.
[[nodiscard]] Recording read_c3d_markers(const std::filesystem::path& path, std::string& unit);

/// Reads only the channels, and for each whether its unit is known.
[[nodiscard]] Recording read_c3d_channels(const std::filesystem::path& path, std::vector<bool>& has_unit);

}  // namespace myoid::recording
