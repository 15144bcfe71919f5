#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/recording/recording.h"

namespace myoid::recording {

/// Markers, channels, plates and events of a C3D file in SI, made of its bytes part by part, with
/// no table of the file's numbers in between: the most memory it takes is that of the result.
/// Throws ReadError.
[[nodiscard]] Recording read_c3d_recording(const std::filesystem::path& path);

/// Only the markers, and the unit as written; none if the file has no points.
[[nodiscard]] Recording read_c3d_markers(const std::filesystem::path& path, std::string& unit);

/// Only the channels, and of each whether its unit is known.
[[nodiscard]] Recording read_c3d_channels(const std::filesystem::path& path,
                                          std::vector<bool>& has_unit);

}  // namespace myoid::recording
