#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace myoid::inline ground {

/// The process that writes into a folder, as named by the folder's lock.
struct FolderOwner {
  long process = 0;
  std::string host;
  std::string since;        ///< UTC, "2026-05-07 14:03:22".
  std::string command;      ///< The command line.
  bool from_empty = false;  ///< The folder was empty when the command began.

  /// Returns "process 4711 on 'lab3' since 2026-05-07 14:03:22 UTC: myoid run study.toml --out results".
  [[nodiscard]] std::string sentence() const;
};

/// Reserves a folder for one process; a second process that asks for the folder is refused. The lock is the kernel's
/// (flock on a file in the folder), so it ends with the process in every case; the file names the owner. If the file
/// system has no such locks, the owner's process number and host decide.
///
/// A folder that was empty belongs to the command that began to fill it until that command calls
/// `finish`. If the command is killed, or stopped by an error such as a full disk, the file stays,
/// and `left_behind` tells the next command.
class FolderLock {
 public:
  static constexpr std::string_view kFile = ".myoid.lock";

  /// Takes an existing folder. Throws InvalidInput if another process holds it, naming the owner,
  /// or if the folder cannot be written.
  explicit FolderLock(std::filesystem::path folder);
  /// Releases the folder and removes the file, except after unfinished results in a folder that was empty.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Returns the owner that did not finish, if there is one.
  [[nodiscard]] const std::optional<FolderOwner>& left_behind() const { return left_behind_; }
  /// Writes this process into the file as the owner.
  void sign(std::string_view command, bool from_empty);
  /// States that the results are complete.
  void finish() { finished_ = true; }

 private:
  std::filesystem::path folder_;
  std::optional<FolderOwner> left_behind_;
  int descriptor_ = -1;
  bool signed_ = false;
  bool from_empty_ = false;
  bool finished_ = false;
};

/// Returns true if the folder holds anything but locks, lists of results, half-written files of killed
/// processes, and an entry named `unless_only`.
[[nodiscard]] bool holds_content(const std::filesystem::path& folder, std::string_view unless_only = "");

}  // namespace myoid::inline ground
