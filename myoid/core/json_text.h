#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace myoid {

/// Renders JSON with `indent` blanks a level; -1 writes one line. All JSON of the program is
/// rendered here. Never throws: bytes that are no UTF-8, as names of files and channels may hold,
/// become U+FFFD.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& json, int indent = 2);

}  // namespace myoid
