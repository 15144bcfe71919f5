#pragma once

#include <filesystem>
#include <string_view>

#include "myoid/study/study.h"

namespace myoid {

/// Reads and validates a study file. Throws ReadError with the line for syntax, unknown keys, wrong
/// types, names that refer to nothing and numbers out of range. The files that the study names stay
/// closed: `check_study` opens them.
[[nodiscard]] Study read_study(const std::filesystem::path& file);

/// The same of a study file's text; `file` is its place, for paths and messages.
[[nodiscard]] Study parse_study(std::string_view text, const std::filesystem::path& file);

}  // namespace myoid
