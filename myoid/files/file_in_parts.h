#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "myoid/files/atomic_file.h"

namespace myoid::recording {

/// The end of a temporary file's name is this mark and six random characters: ".ik.mot.myoid-part.a1B2c3".
inline constexpr std::string_view kTemporaryMark = ".myoid-part.";
inline constexpr std::string_view kTemporaryRandom = "XXXXXX";  ///< For mkostemp.

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

}  // namespace myoid::recording
