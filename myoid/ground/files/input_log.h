#pragma once

#include <filesystem>
#include <string_view>

#include <sys/stat.h>

namespace myoid::inline ground {

/// While an object lives, the readers of this process remember the files that they open: the inputs of a command. No
/// writer replaces an input and nothing removes one (result_record.h). Files are compared by device and inode, so that
/// another path, a symbolic link or a hard link is the same file. A file that this process wrote is no input.
/// Lives of several objects may overlap; the end of the last one forgets all files.
class InputLog {
 public:
  InputLog();
  ~InputLog();
  InputLog(const InputLog&) = delete;
  InputLog& operator=(const InputLog&) = delete;
};

/// Remembers the regular file behind a descriptor as an input, if an InputLog lives.
void note_input(int descriptor);

/// Remembers the file behind a descriptor as a work of this process.
void note_own_file(int descriptor);

/// Returns true if the file is an input.
[[nodiscard]] bool is_input(const struct stat& file);
[[nodiscard]] bool is_input(const std::filesystem::path& path);

/// Returns true if a regular file begins with these bytes. Looked at this way, the file becomes no input.
[[nodiscard]] bool begins_with(const std::filesystem::path& path, std::string_view bytes);

}  // namespace myoid::inline ground
