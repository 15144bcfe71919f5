#include "myoid/core/json_text.h"

#include <nlohmann/json.hpp>

#include "myoid/core/document_limits.h"

namespace myoid {
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

}  // namespace myoid
