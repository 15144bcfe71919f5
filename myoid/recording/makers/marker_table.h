#pragma once

#include <filesystem>
#include <string_view>

#include "myoid/recording/tables/marker_file.h"

namespace myoid::recording {

/// Returns true if a text is a table of marker positions exported by one of these programs: Vicon Nexus (.csv with a
/// section "Trajectories"), Qualisys (.tsv, DATA_INCLUDED 3D), BTS (.emt, "Point 3D tracks"), OptiTrack Motive (.csv),
/// NDI First Principles (.csv: "NAME x", "NAME y", "NAME z" and a collection frequency).
[[nodiscard]] bool is_marker_table(std::string_view text);

/// Reads the markers of such a table. An empty cell is a gap; in Qualisys' files 0 0 0 is one too. Time is the file's
/// own column in seconds, otherwise (frame - 1) / rate. The unit is the stated one, otherwise mm: by definition in
/// Qualisys' files, with a note in others. Throws ReadError with the line: no rate, a cell that is no number, a row
/// that is too short, frames that do not increase, a repeated name.
[[nodiscard]] MarkerFile parse_marker_table(std::string_view text, const std::filesystem::path& path);

}  // namespace myoid::recording
