#pragma once

#include <filesystem>
#include <string>

namespace myoid::recording {

/// Returns the day on which a file was recorded, "2026-03-01", as the file itself states it: the start of an EDF or BDF
/// file, TRIAL:DATE of a C3D file. Empty for other formats, for a file without such a day, and for 1 January 1985,
/// which EDF+ prescribes where the day is kept secret. Throws ReadError if the file cannot be read.
[[nodiscard]] std::string recorded_day(const std::filesystem::path& path);

}  // namespace myoid::recording
