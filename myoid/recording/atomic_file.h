#pragma once

#include <filesystem>
#include <string_view>

namespace myoid::recording {

/// Writes a file whole or not at all: into a temporary file of the same folder, flushed to the
/// disk, then renamed. Missing parent folders are made. Throws InvalidInput with the cause (disk
/// full, no permission) and leaves an existing file as it was.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace myoid::recording
