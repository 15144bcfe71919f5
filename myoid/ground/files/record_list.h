#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <unistd.h>

namespace myoid::inline ground {

/// The list of the files that this program wrote into a folder, with the SHA-256 of the content of each: the signature
/// of a folder of results. `sha256sum -c .myoid.files` compares a folder with its list. The list names the command
/// that wrote each file.
inline constexpr std::string_view kRecordFile = ".myoid.files";

/// The first line of a list.
inline constexpr std::string_view kSignature =
    "# myoid: files that this program wrote into this folder, with the SHA-256 of each; it removes and replaces no "
    "others\n";
/// A line "# by run" names the command that wrote the files of the lines below; "# by run, unfinished" one that did not
/// reach its end.
inline constexpr std::string_view kBy = "# by ";
inline constexpr std::string_view kUnfinished = ", unfinished";

/// One statement of a list about a file.
struct RecordedFile {
  std::string sha256, command;
  bool whole = true;
};

/// A list: the statements about each path, the last one last, and the commands that signed.
struct RecordContent {
  std::map<std::string, std::vector<RecordedFile>> files;
  std::set<std::string> commands;
  bool exists = false;
};

/// A descriptor that is closed with this object.
class OpenFile {
 public:
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
  OpenFile(OpenFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  OpenFile& operator=(OpenFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  [[nodiscard]] int get() const { return descriptor_; }
  explicit operator bool() const { return descriptor_ >= 0; }

 private:
  int descriptor_;
};

/// Reads a file from its begin, whatever the descriptor's place; empty if the reading fails.
[[nodiscard]] std::optional<std::string> content_of(int descriptor);
/// Returns the SHA-256 of a file, read part by part; empty if the reading fails.
[[nodiscard]] std::string hash_of(int descriptor);

/// Returns the line of a file as sha256sum writes it. A line whose path holds a backslash or a line end begins with a
/// backslash, and its path is escaped.
[[nodiscard]] std::string record_line(const std::string& sha256, const std::string& path);
/// Reads a list. Paths that leave the folder, and lines that are none, count for nothing; `exists` is false for a text
/// without the first line of a list.
[[nodiscard]] RecordContent parse_record(std::string_view text);
[[nodiscard]] std::string record_text(const RecordContent& record);

/// Reads the list of a folder; empty where there is none, or where a symbolic link has its name.
[[nodiscard]] RecordContent read_record(const std::filesystem::path& folder);
/// Returns a sentence on each of the named files of a folder of results whose content is not the one on its list.
/// Files that are not there or that the list does not name count for nothing.
[[nodiscard]] std::vector<std::string> changed_since_written(const std::filesystem::path& folder,
                                                             const std::vector<std::string>& names);
/// Opens the list of a folder for changes, locked, and makes an empty one where there is none. Throws InvalidInput if
/// the folder cannot be written into or the file is no list.
[[nodiscard]] OpenFile open_record(const std::filesystem::path& folder);
/// Appends a text to the list of a folder. Throws InvalidInput with the cause.
void append_text(const std::filesystem::path& folder, const OpenFile& file, std::string_view text);

}  // namespace myoid::inline ground
