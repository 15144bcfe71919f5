#pragma once

#include <filesystem>
#include <string_view>

#include "myoid/study/study.h"

namespace myoid::study {

/// Reads and validates a study file. Throws ReadError with the line for syntax, unknown keys, wrong types, unknown
/// names and numbers out of range. Does not open the files that the study names; `check_study` opens them.
[[nodiscard]] Study read_study(const std::filesystem::path& file);

/// Reads the table [beliefs] of a study file, or of a file that has no other table. Throws ReadError with the line, and
/// where there is no such table.
[[nodiscard]] fit::UnseenSpreads read_beliefs(const std::filesystem::path& file);

/// Reads a study from its text; `file` is its place, for paths and messages.
[[nodiscard]] Study parse_study(std::string_view text, const std::filesystem::path& file);

}  // namespace myoid::study
