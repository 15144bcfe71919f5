#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace myoid::inline ground {

/// The place on this computer of a file that a document names.
struct NamedFile {
  std::filesystem::path path;  ///< Its place; its expected place, if it was not found.
  bool exists = false;
  std::string note{};  ///< A sentence, if the place differs from the document's statement.
};

/// Finds the file that a document in `folder` names by `name`: relative to the folder or absolute,
/// with / or \ between folders. A name from another computer ("C:\trial\ik.mot", "\\server\ik.mot",
/// "../old/ik.mot") stands for the file with the longest end of that path in the folder or one
/// folder up. Case is ignored if only one file fits. Does not throw for missing files.
[[nodiscard]] NamedFile find_named_file(const std::filesystem::path& folder, std::string_view name);

/// Says that a file which a document in `folder` names is missing: "there is no such file; beside it are a.mot, b.mot
/// (did you mean 'a.mot'?)", with the files of the same ending, and where else a file of that name would be found.
[[nodiscard]] std::string missing_file(const std::filesystem::path& folder, std::string_view name);

/// Returns the name with / between folders, relative to `folder` unless it is absolute on this system.
[[nodiscard]] std::filesystem::path native_path(const std::filesystem::path& folder, std::string_view name);

/// Returns the last part of a name with / or \ between folders.
[[nodiscard]] std::string last_part(std::string_view name);

/// Returns true for "C:\trial" or "\\server\trial", which are absolute on Windows; tested on every system.
[[nodiscard]] bool is_windows_path(std::string_view name);

}  // namespace myoid::inline ground
