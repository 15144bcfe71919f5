#pragma once

#include <exception>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace myoid::inline ground {

/// Renders JSON with `indent` blanks a level; -1 writes one line. All JSON of the program is rendered here. Never
/// throws: bytes that are no UTF-8, as names of files and channels may hold, become U+FFFD.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& json, int indent = 2);

/// Parses JSON; the fields of an object are sorted by name. Throws nlohmann::json::parse_error where the text is not
/// JSON or breaks a limit of documents (document_limits.h); without `throws` the value is then a discarded one. All
/// JSON is parsed here: a parser takes 2 s to compile.
[[nodiscard]] nlohmann::json parse_json(std::string_view text, bool throws = true);

/// Parses JSON as parse_json does; the fields of an object keep their order.
[[nodiscard]] nlohmann::ordered_json parse_ordered_json(std::string_view text);

/// Returns what is wrong with a JSON text, in the words of this program: "the text breaks off or is damaged at byte
/// 5120",
/// "'methods' is missing". `error` is a nlohmann::json::exception; its own words are a programmer's.
[[nodiscard]] std::string json_error_text(const std::exception& error);

}  // namespace myoid::inline ground
