#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "myoid/commands/call.h"
#include "myoid/contents/model_contents.h"

namespace myoid::commands {

/// The content of one file.
struct InfoOptions {
  Call call;
  std::string file;              ///< A recording, table, model or study; or "arm4".
  std::string compat = "exact";  ///< Of a model: exact, or opensim.
  ModelQuestions ask;            ///< Of a model; its seed is the call's.
};

/// "file", "kind" and the content: channels, units, rates, bodies, muscles, ...
/// (`contents_text` makes text of it). Throws ReadError for a file of no known kind.
[[nodiscard]] nlohmann::ordered_json info(const InfoOptions& options);

/// True if the name belongs to a model: an .osim file, or the built-in "arm4".
[[nodiscard]] bool is_model(const std::string& file);

}  // namespace myoid::commands
