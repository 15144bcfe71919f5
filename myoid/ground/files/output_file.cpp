#include "myoid/ground/files/output_file.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/input_log.h"
#include "myoid/ground/files/result_record.h"

namespace myoid::inline ground {

void check_output(const std::filesystem::path& path, const std::vector<std::string>& inputs, bool overwrite) {
  namespace fs = std::filesystem;
  if (path.empty()) throw InvalidInput("--out is empty; name the file to write");
  std::error_code ignored;
  for (const std::string& input : inputs) {
    // A folder of the path that does not exist ("new/../a.sto") hides the file from `equivalent`.
    if (fs::weakly_canonical(path, ignored) == fs::weakly_canonical(input, ignored) ||
        fs::equivalent(path, input, ignored)) {
      throw InvalidInput(fmt::format(
          "{} is an input of this command and would be replaced by its result; give another place", path.string()));
    }
  }
  if (!overwrite && fs::is_regular_file(path, ignored) && standing_of(path) != Standing::unfinished) {
    throw InvalidInput(
        fmt::format("{} exists already; give --overwrite to replace it, or another place", path.string()));
  }
}

void check_companion(const std::filesystem::path& path,
                     const std::vector<std::string>& inputs,
                     bool overwrite,
                     std::string_view begins) {
  check_output(path, inputs, overwrite);
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return;
  if (!begins_with(path, begins))
    throw InvalidInput(fmt::format(
        "{} stands in the way of a second file of this command and does not begin with '{}', as its results do; move "
        "it elsewhere, or give another place",
        path.string(), begins.substr(0, begins.find('\n'))));
}

void protect_files(const std::filesystem::path& folder,
                   const std::vector<std::string_view>& results,
                   const std::vector<std::string>& inputs) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const auto is_result = [&](const std::string& file) {
    return std::ranges::any_of(results, [&](std::string_view result) { return file.starts_with(result); });
  };
  for (const std::string& input : inputs) {
    const fs::path parent = fs::path(input).parent_path();
    if (!fs::equivalent(parent.empty() ? fs::path(".") : parent, folder, ignored)) continue;
    if (is_result(fs::path(input).filename().string()))
      throw InvalidInput(
          fmt::format("{} is an input of this command and would be replaced by a result; give another place", input));
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (!entry.is_directory(ignored) && is_result(entry.path().filename().string())) require_replaceable(entry.path());
}

}  // namespace myoid::inline ground
