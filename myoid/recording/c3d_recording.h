#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/recording/c3d/c3d_file.h"
#include "myoid/recording/recorded_trial.h"

namespace myoid::recording {

/// Reads markers, channels, plates and events of a C3D file in SI. The bytes are converted part by
/// part, so that memory holds little more than the result. Throws ReadError.
[[nodiscard]] Recording read_c3d_recording(const std::filesystem::path& path);

/// Reads the same; `repairs` has the notes on the file and its plates, without those on markers.
[[nodiscard]] Recording read_c3d_plates(const std::filesystem::path& path);

/// What a file states of the person.
struct StatedBody {
  std::optional<double> mass_kg, height_m;
};

/// Returns body mass and height of Vicon's group PROCESSING (BODYMASS in kg, HEIGHT in mm). A mass outside 5 to 300 kg
/// and a height outside 0.4 to 2.5 m are none.
[[nodiscard]] StatedBody stated_body(const C3dFile& file);
/// Reads the same of a file; nothing of other formats. Throws ReadError.
[[nodiscard]] StatedBody read_stated_body(const std::filesystem::path& path);

/// Reads only the markers, and the unit as written; no markers if the file has no points.
[[nodiscard]] Recording read_c3d_markers(const std::filesystem::path& path, std::string& unit);

/// Reads only the channels, and for each whether its unit is known. The plates are as the parameters describe them.
[[nodiscard]] Recording read_c3d_channels(const std::filesystem::path& path, std::vector<bool>& has_unit);

}  // namespace myoid::recording
