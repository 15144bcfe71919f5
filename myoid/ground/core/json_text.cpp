#include "myoid/ground/core/json_text.h"

#include <nlohmann/json.hpp>

#include "myoid/ground/core/document_limits.h"

namespace myoid::inline ground {
namespace {

/// Throws the parser's error where the text breaks a limit of documents.
void keep_limits(std::string_view text) {
  if (const auto fault = json_fault(text))
    throw nlohmann::json::parse_error::create(101, fault->offset, fault->message,
                                              static_cast<nlohmann::json*>(nullptr));
}

}  // namespace

std::string json_text(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

nlohmann::json parse_json(std::string_view text, bool throws) {
  if (!throws && json_fault(text)) return nlohmann::json(nlohmann::json::value_t::discarded);
  if (throws) keep_limits(text);
  return nlohmann::json::parse(text, nullptr, throws);
}

nlohmann::ordered_json parse_ordered_json(std::string_view text) {
  keep_limits(text);
  return nlohmann::ordered_json::parse(text);
}

std::string json_error_text(const std::exception& error) {
  using nlohmann::json;
  const std::string_view what = error.what();
  if (const auto* parse = dynamic_cast<const json::parse_error*>(&error)) {
    const std::string at = " at byte " + std::to_string(parse->byte);
    // Only a broken limit of documents has its message behind the byte.
    const std::string head = at + ": ";
    if (const std::size_t own = what.find(head); own != std::string_view::npos)
      return std::string(what.substr(own + head.size())) + at;
    return "the text breaks off or is damaged" + at;
  }
  const auto* range = dynamic_cast<const json::out_of_range*>(&error);
  constexpr int kNoSuchKey = 403;
  if (range != nullptr && range->id == kNoSuchKey) {
    const std::size_t first = what.find('\''), last = what.rfind('\'');
    if (first < last) return std::string(what.substr(first, last - first + 1)) + " is missing";
  }
  if (range != nullptr) return "a list is shorter than expected";
  return "a value is of another kind than expected";
}

}  // namespace myoid::inline ground
