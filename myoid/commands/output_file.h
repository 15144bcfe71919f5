#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::commands {

/// Checks the file of a result. Throws InvalidInput with the remedy if `path` is empty, is one of
/// the `inputs` (with `overwrite` too), or exists and `overwrite` is not given.
void check_output(const std::filesystem::path& path, const std::vector<std::string>& inputs, bool overwrite);

/// Checks a folder of results, whose names begin with `results`. Throws InvalidInput if a result
/// would replace one of the `inputs`.
void protect_inputs(const std::filesystem::path& folder,
                    const std::vector<std::string_view>& results,
                    const std::vector<std::string>& inputs);

}  // namespace myoid::commands
