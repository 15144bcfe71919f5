#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace myoid::recording {

/// For a file that cannot be read as what an option expects: empty, or, if the ending of its name
/// belongs to another kind of file than `endings`, "this is a .trc file (markers), but WANTED is
/// expected here: were two options mixed up?".
[[nodiscard]] std::string wrong_kind(const std::filesystem::path& path,
                                     std::initializer_list<std::string_view> endings,
                                     std::string_view wanted);

}  // namespace myoid::recording
