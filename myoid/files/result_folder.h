#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/files/folder_lock.h"

namespace myoid::recording {

/// A folder that one command fills with its results. The folder is made where it is missing, and no
/// other process may write into it until the object ends.
class ResultFolder {
 public:
  /// Takes the folder. A folder with content other than an entry `unless_only` needs `overwrite`,
  /// except where the same command left it unfinished. `command` is the command line. Throws
  /// InvalidInput for a file, for a folder with content, and for one that another process holds.
  ResultFolder(std::filesystem::path folder,
               const std::string& command,
               bool overwrite,
               std::string_view unless_only = "");
  /// Takes the folder of finished results, which exists.
  ResultFolder(std::filesystem::path folder, const std::string& command);
  /// Gives the folder back, and removes folders that this object made and that are empty.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Returns a sentence if the folder comes from an unfinished command, else an empty text.
  [[nodiscard]] const std::string& note() const { return note_; }
  /// States that the results are complete.
  void finish();

 private:
  void make();

  std::filesystem::path path_;
  std::string note_;
  std::vector<std::filesystem::path> made_;  ///< Innermost first.
  std::unique_ptr<FolderLock> lock_;
};

}  // namespace myoid::recording
