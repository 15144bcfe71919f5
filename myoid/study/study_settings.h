#pragma once

#include <filesystem>

#include "myoid/files/toml_table.h"
#include "myoid/study/study.h"

namespace myoid {

/// Reads every table that a study has once, from [subject] to [truth], into `study`; what is absent
/// keeps its default, and a study without [model] gets the built-in arm. Paths are resolved against
/// `folder`. Throws ReadError with the line for a key, type or number that cannot be meant.
void read_settings(recording::TomlTable& table, const std::filesystem::path& folder, Study& study);

}  // namespace myoid
