#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace myoid::recording {

/// Writes a file whole or not at all: into a temporary file of the same folder, flushed to the
/// disk, then renamed. Missing parent folders are made. Through a symbolic link the file it points
/// to is replaced and the link stays; an existing file keeps its permissions. What is no file (a
/// pipe, a device such as /dev/stdout) is written to as it is. Throws InvalidInput with the cause
/// (disk full, no permission, a folder of that name) and leaves an existing file as it was.
///
/// `Flush::later` leaves it to the system when the disk gets it: many times faster for many files,
/// which a loss of power within seconds may leave empty or, where it replaces another, missing; for
/// results that can be computed again.
enum class Flush { now, later };
void write_file(const std::filesystem::path& path,
                std::string_view content,
                Flush flush = Flush::now);

/// True if a file of this name is the temporary one of `write_file`: ".ik.mot.myoid-part.a1B2c3".
[[nodiscard]] bool is_temporary(const std::filesystem::path& name);

/// Removes the temporary files that a killed process left in the folder and below it, and returns
/// their number. A file that a living process writes stays: the writer holds a lock on it.
std::size_t sweep_temporaries(const std::filesystem::path& folder);

}  // namespace myoid::recording
