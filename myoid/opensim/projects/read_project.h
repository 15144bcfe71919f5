#pragma once

#include <filesystem>
#include <optional>

#include "myoid/opensim/projects/project.h"

namespace myoid::opensim {

/// Reads a project of CEINMS, CEINMS-RT, NMSM or the muscle redundancy solver from its folder, its set-up or script, or
/// a calibrated subject, which are told by content. Nothing is written. Empty if the path is neither; of a folder with
/// several set-ups, the first by name is read, with a remark. Throws ReadError, with the line, for a file of the
/// project that is damaged.
[[nodiscard]] std::optional<Project> read_project(const std::filesystem::path& path);

}  // namespace myoid::opensim
