#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/ground/files/folder_lock.h"
#include "myoid/ground/files/result_record.h"

namespace myoid::inline ground {

/// Returns true for a folder of results of a version of this program that kept no list of its files.
[[nodiscard]] bool is_of_earlier_version(const std::filesystem::path& folder);

/// Throws ReadError for a folder without the file `name` of a run's results ("run.json"). The error names a folder in
/// it that holds the file.
void require_results(const std::filesystem::path& folder, std::string_view name);

/// Throws InvalidInput, with the remedy, for the root of the file system: results need a folder of their own.
void require_results_place(const std::filesystem::path& folder);

/// A folder that one command fills with its results. The folder is made where it is missing, and no
/// other process may write into it until the object ends. The folder's list (result_record.h) names the files.
class ResultFolder {
 public:
  /// Takes the folder. A folder with content other than an entry `unless_only` needs `overwrite`,
  /// except where the same command left it unfinished. `command` is the command line. Throws
  /// InvalidInput for a file, for a folder with content, and for one that another process holds.
  ResultFolder(std::filesystem::path folder,
               const std::string& command,
               bool overwrite,
               std::string_view unless_only = "");
  /// Takes the folder to add to, or to compute again, the results of the command `word` ("cohort"), which wrote the
  /// folder's list. Another folder with content needs `overwrite`.
  ResultFolder(std::filesystem::path folder, const std::string& command, std::string word, bool overwrite);
  /// Gives the folder back, and removes folders that this object made and that are empty.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Returns a sentence if the folder comes from an unfinished command, else an empty text.
  [[nodiscard]] const std::string& note() const { return note_; }
  /// Writes the folder's list before the first result.
  void sign() { record_->sign(); }
  /// States that the results are complete.
  void finish();
  /// Returns a sentence on files that were moved aside, kept or left alone.
  [[nodiscard]] std::vector<std::string> take_notes() { return record_->take_notes(); }

 private:
  void make();
  void lock(const std::string& command,
            const std::string& word,
            bool overwrite,
            bool continues,
            std::string_view unless_only);

  std::filesystem::path path_;
  std::string note_;
  std::vector<std::filesystem::path> made_;  ///< Innermost first.
  std::unique_ptr<FolderLock> lock_;
  std::unique_ptr<RecordedFolder> record_;
};

}  // namespace myoid::inline ground
