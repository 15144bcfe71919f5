#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace myoid::commands {

/// For a result that is one file. Throws InvalidInput with the remedy if `path` is empty, is one of
/// the `inputs` (with `overwrite` too), or exists and `overwrite` is not given.
void check_output(const std::filesystem::path& path,
                  const std::vector<std::string>& inputs,
                  bool overwrite);

}  // namespace myoid::commands
