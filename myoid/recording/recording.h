#pragma once

#include <filesystem>
#include <string>

#include "myoid/ground/core/remark.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/recorded_trial.h"
#include "myoid/recording/tables/marker_file.h"

namespace myoid::recording {

/// Reads the markers of a file; its extension decides the format (`format_of`). Throws ReadError if
/// the format or the file has no markers.
[[nodiscard]] MarkerFile read_markers(const std::filesystem::path& path);

/// Reads the whole recording; the file's extension decides the format (`format_of`). Channels of a
/// storage file (.sto, .mot) have no unit. Throws ReadError.
[[nodiscard]] Recording read_recording(const std::filesystem::path& path);

/// Throws ReadError with the next command if the path is a folder: for a study in it, for recordings in it.
void refuse_folder(const std::filesystem::path& path);

/// Returns "line 3: message", or the message alone if the repair has no line.
[[nodiscard]] std::string to_string(const Repair& repair);

/// Returns "flex.sto:3: message", or "flex.sto: message" if the repair has no line.
[[nodiscard]] std::string to_string(const std::filesystem::path& path, const Repair& repair);

/// Returns a repair as a note, with `says` for its sentence. A file that holds less than its header states is a
/// warning.
[[nodiscard]] Remark remark_of(const Repair& repair, std::string says);

}  // namespace myoid::recording
