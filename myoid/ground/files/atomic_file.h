#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace myoid::inline ground {

/// Writes a file completely or not at all: into a temporary file of the same folder, flushed to the disk, then renamed.
/// Creates missing parent folders. For a symbolic link, the target is replaced and the link stays; an existing file
/// keeps its permissions. A pipe or a device such as /dev/stdout is written to directly. Throws InvalidInput with the
/// cause (disk full, no permission, a folder of that name) and leaves an existing file unchanged.
///
/// `Flush::later` lets the system choose when to write to the disk, which is many times faster for
/// many files. A loss of power within seconds may leave such a file empty or, where it replaces
/// another, missing: only for results that can be computed again.
enum class Flush { now, later };
void write_file(const std::filesystem::path& path, std::string_view content, Flush flush = Flush::now);

/// A file that is written piece by piece and appears completely or not at all. The pieces go into a
/// temporary file of the same folder, which `finish` flushes to the disk and renames. Links,
/// permissions, pipes and errors are handled as in `write_file`.
class FileInParts {
 public:
  explicit FileInParts(std::filesystem::path path, Flush flush = Flush::now);
  /// Removes the temporary file unless it was finished.
  ~FileInParts();
  FileInParts(const FileInParts&) = delete;
  FileInParts& operator=(const FileInParts&) = delete;

  void append(std::string_view piece);
  void finish();

 private:
  [[noreturn]] void fail(std::string_view what, int cause);

  std::filesystem::path path_, target_;
  std::string temporary_;  ///< Empty if the path is written to directly.
  Flush flush_;
  bool replaces_ = false;
  unsigned permissions_ = 0644;
  int descriptor_ = -1;
};

/// The end of a temporary file's name is this mark and six random characters: ".ik.mot.myoid-part.a1B2c3".
inline constexpr std::string_view kTemporaryMark = ".myoid-part.";
inline constexpr std::string_view kTemporaryRandom = "XXXXXX";  ///< For mkostemp.

/// Returns true if a file of this name is the temporary one of `write_file`: ".ik.mot.myoid-part.a1B2c3".
[[nodiscard]] bool is_temporary(const std::filesystem::path& name);

/// Removes the temporary files that killed processes left in the folder and below it, and returns
/// their number. The file of a running process stays: its writer holds a lock on it.
std::size_t sweep_temporaries(const std::filesystem::path& folder);

}  // namespace myoid::inline ground
