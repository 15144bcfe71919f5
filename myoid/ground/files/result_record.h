#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/ground/files/record_list.h"

namespace myoid::inline ground {

/// The kind of file that stands at a place.
enum class Standing {
  absent,
  result,      ///< Written by the same command, and unchanged since.
  unfinished,  ///< The same, by a command that did not reach its end.
  changed,     ///< Written by this program, and changed since.
  other,       ///< An unchanged result of another command of this program.
  foreign,     ///< No record names it, or it is a link.
  input,       ///< An input of the running command (InputLog).
};

/// The rules by which a command treats files in its folder of results.
struct RecordTerms {
  /// The folder was filled by a version of this program that kept no list: what stands in the way is moved aside.
  bool earlier_version = false;
  /// No other process writes into the folder: at the end every result of the command is whole.
  bool alone = false;
  /// A file that changed is replaced, not moved aside: for files that only this program uses.
  bool replaces_changed = false;
  /// A foreign table or XML document is replaced if it begins as the new file does: with the same title, or with
  /// elements of the same names. It is a result of the same tool of another program.
  bool replaces_alike = false;
};

struct HeldRecord;

/// A folder into which a command writes. While the object lives, every writer of this process that writes into the
/// folder (atomic_file.h) puts the file on the folder's list, and refuses to replace anything but a result of the same
/// command. A result that a person changed is moved into the folder `kept-1` (`kept-2`, ...) when a new result takes
/// its name. The innermost of several such folders counts.
class RecordedFolder {
 public:
  /// `command` is the word of the command: "run". The folder need not exist.
  RecordedFolder(const std::filesystem::path& folder, std::string command, RecordTerms terms = {});
  /// Leaves the files of an unfinished command on the list as such.
  ~RecordedFolder();
  RecordedFolder(const RecordedFolder&) = delete;
  RecordedFolder& operator=(const RecordedFolder&) = delete;

  /// Returns true if the folder has a list; with a command, if that command signed it or wrote one of its files.
  [[nodiscard]] bool is_signed() const;
  [[nodiscard]] bool is_signed_by(std::string_view command) const;
  /// Writes the list of a folder that has no results yet.
  void sign();
  /// States that the results are complete, and leaves what no longer exists out of the list.
  void finish();
  /// Returns a sentence on files that were moved aside, kept or left alone, each once.
  [[nodiscard]] std::vector<std::string> take_notes();

 private:
  std::shared_ptr<HeldRecord> held_;
};

/// Returns what stands at a place. Outside every RecordedFolder of this process an existing file is `foreign` or
/// `input`.
[[nodiscard]] Standing standing_of(const std::filesystem::path& file);

/// Returns the word of the command that wrote a file, by the list of its folder; empty if the list does not name it.
[[nodiscard]] std::string author_of(const std::filesystem::path& file);

/// The one function that removes results: those files of a folder that its list names as written by the running
/// command, in this session or an earlier one, except those in `kept`. A file stays if its content is not the one on
/// the list, if it is an input, or if a symbolic link leads to it. Folders that become empty go too. Does nothing
/// unless a RecordedFolder holds the folder.
void remove_results(const std::filesystem::path& folder, const std::set<std::string>& kept = {});
/// Removes the results of earlier sessions only, so that files of two studies never stand side by side.
void remove_earlier_results(const std::filesystem::path& folder);
/// Removes one result in the same way.
void remove_result(const std::filesystem::path& file);

/// Returns the content of a result of the running command if it is the one on the list; such a file is no input.
[[nodiscard]] std::optional<std::string> recorded_content(const std::filesystem::path& file);

/// Writes a file unless a foreign one has its place; a note then says so.
void write_unless_foreign(const std::filesystem::path& file, std::string_view content);

/// Throws InvalidInput with the remedy if a result must not be written at this place.
void require_replaceable(const std::filesystem::path& file);
/// For writers: the same, and moves a changed result aside.
void make_way(const std::filesystem::path& file);
/// For writers: puts a file on the list before it appears at its place; `descriptor` reads its content.
void record_file(const std::filesystem::path& file, int descriptor);

}  // namespace myoid::inline ground
