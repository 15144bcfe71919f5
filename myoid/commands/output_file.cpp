#include "myoid/commands/output_file.h"

#include <fmt/format.h>

#include "myoid/core/error.h"

namespace myoid::commands {

void check_output(const std::filesystem::path& path, const std::vector<std::string>& inputs, bool overwrite) {
  namespace fs = std::filesystem;
  if (path.empty()) throw InvalidInput("--out is empty; name the file to write");
  std::error_code ignored;
  for (const std::string& input : inputs) {
    // A folder of the path that does not exist ("new/../a.sto") hides the file from `equivalent`.
    if (fs::weakly_canonical(path, ignored) == fs::weakly_canonical(input, ignored) ||
        fs::equivalent(path, input, ignored)) {
      throw InvalidInput(fmt::format(
          "{} is an input of this command and would be replaced by its result; give another --out", path.string()));
    }
  }
  if (!overwrite && fs::is_regular_file(path, ignored)) {
    throw InvalidInput(
        fmt::format("{} exists already; give --overwrite to replace it, or another --out", path.string()));
  }
}

void protect_inputs(const std::filesystem::path& folder,
                    const std::vector<std::string_view>& results,
                    const std::vector<std::string>& inputs) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  for (const std::string& input : inputs) {
    const fs::path parent = fs::path(input).parent_path();
    if (!fs::equivalent(parent.empty() ? fs::path(".") : parent, folder, ignored)) continue;
    const std::string file = fs::path(input).filename().string();
    for (const std::string_view result : results) {
      if (file.starts_with(result)) {
        throw InvalidInput(
            fmt::format("{} is an input of this command and would be replaced by a result; give another --out", input));
      }
    }
  }
}

}  // namespace myoid::commands
