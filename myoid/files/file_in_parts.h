#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "myoid/files/atomic_file.h"

namespace myoid::recording {

/// The name of a temporary file ends in both: ".ik.mot.myoid-part.a1B2c3".
inline constexpr std::string_view kTemporaryMark = ".myoid-part.";
inline constexpr std::string_view kTemporaryRandom = "XXXXXX";  ///< For mkostemp.

/// A file that is written piece by piece and is there whole or not at all: the pieces go into a
/// temporary file of the same folder, which `finish` flushes to the disk and renames. Missing
/// parent folders are made. Through a symbolic link the file it points to is replaced and the link
/// stays; an existing file keeps its permissions. What is no file (a pipe, a device such as
/// /dev/stdout) is written to as it is. Throws InvalidInput with the cause (disk full, no
/// permission, a folder of that name) and leaves an existing file as it was.
class FileInParts {
 public:
  explicit FileInParts(std::filesystem::path path, Flush flush = Flush::now);
  /// Takes the pieces away unless they were finished.
  ~FileInParts();
  FileInParts(const FileInParts&) = delete;
  FileInParts& operator=(const FileInParts&) = delete;

  void append(std::string_view piece);
  void finish();

 private:
  [[noreturn]] void fail(std::string_view what, int cause);

  std::filesystem::path path_, target_;
  std::string temporary_;  ///< Empty where the path is written to as it is.
  Flush flush_;
  bool replaces_ = false;
  unsigned permissions_ = 0644;
  int descriptor_ = -1;
};

}  // namespace myoid::recording
