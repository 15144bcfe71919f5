#include "myoid/core/json_text.h"

#include <nlohmann/json.hpp>

namespace myoid {

std::string json_text(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

nlohmann::json parse_json(std::string_view text, bool throws) { return nlohmann::json::parse(text, nullptr, throws); }

nlohmann::ordered_json parse_ordered_json(std::string_view text) { return nlohmann::ordered_json::parse(text); }

}  // namespace myoid
