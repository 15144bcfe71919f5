#include "myoid/pipeline/tool_stages.h"

#include <fmt/format.h>

#include "myoid/core/error.h"

namespace myoid::pipeline {

void claim_file(const ToolOptions& options, const std::filesystem::path& path, ToolResult& result) {
  std::error_code ignored;
  const bool exists = std::filesystem::exists(path, ignored);
  for (const std::filesystem::path& input : result.inputs) {
    if (path != input && (!exists || !std::filesystem::equivalent(path, input, ignored))) continue;
    throw InvalidInput(fmt::format(
        "{} is read by this set-up and would be replaced by its result; name another file for one "
        "of them",
        path.string()));
  }
  if (options.claim) options.claim(path);
  if (exists) ++result.replaced;
  result.files.push_back(path);
}

}  // namespace myoid::pipeline
