#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::inline ground {

/// Checks the file of a result. Throws InvalidInput with the remedy if `path` is empty, is one of
/// the `inputs` (with `overwrite` too), or exists and `overwrite` is not given. A file that the same command left in an
/// unfinished folder needs no `overwrite`.
void check_output(const std::filesystem::path& path, const std::vector<std::string>& inputs, bool overwrite);

/// Checks a file that stands beside the file that the user names. Beyond `check_output`, an existing one must begin as
/// such a file does: the user did not name it.
void check_companion(const std::filesystem::path& path,
                     const std::vector<std::string>& inputs,
                     bool overwrite,
                     std::string_view begins);

/// Checks a folder of results, whose names begin with `results`, before anything is computed. Throws InvalidInput if a
/// result would replace one of the `inputs`, or a file that no result of the command may replace.
void protect_files(const std::filesystem::path& folder,
                   const std::vector<std::string_view>& results,
                   const std::vector<std::string>& inputs);

}  // namespace myoid::inline ground
