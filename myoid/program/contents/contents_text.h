#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace myoid::program {

/// Renders the description of a file (`recording_contents`, `model_contents`) for people: a line for each key, and the
/// members of a list indented below it. Never throws: bytes that are no UTF-8 become U+FFFD.
[[nodiscard]] std::string contents_text(const nlohmann::ordered_json& contents);

}  // namespace myoid::program
