#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace myoid::recording {

/// A file that a document names, where it lies on this computer.
struct NamedFile {
  std::filesystem::path path;  ///< Where it lies; where it should lie, if it was not found.
  bool exists = false;
  std::string note{};  ///< A sentence, if it lies elsewhere than the document says.
};

/// Finds the file that a document in `folder` names by `name`, which is relative to the folder or
/// absolute, with / or \ between folders. A name from another computer ("C:\trial\ik.mot",
/// "\\server\ik.mot", "../old/ik.mot") stands for the file at the longest end of that path which
/// lies in the folder or one folder up; the case of letters may differ if one file fits. Throws
/// nothing for files that are not there.
[[nodiscard]] NamedFile find_named_file(const std::filesystem::path& folder, std::string_view name);

/// The name with / between folders, and relative to `folder` unless it is absolute here.
[[nodiscard]] std::filesystem::path native_path(const std::filesystem::path& folder,
                                                std::string_view name);

/// The last part of a name with / or \ between folders.
[[nodiscard]] std::string last_part(std::string_view name);

/// "C:\trial" or "\\server\trial": absolute on Windows, wherever this program runs.
[[nodiscard]] bool is_windows_path(std::string_view name);

}  // namespace myoid::recording
