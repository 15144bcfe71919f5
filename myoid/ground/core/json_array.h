#pragma once

#include <nlohmann/json.hpp>

namespace myoid::inline ground {

/// Returns the members of a list as a JSON array, each by `json_of`.
template <typename List, typename JsonOf>
[[nodiscard]] nlohmann::ordered_json array_of(const List& list, const JsonOf& json_of) {
  nlohmann::ordered_json array = nlohmann::ordered_json::array();
  for (const auto& item : list) array.push_back(json_of(item));
  return array;
}

}  // namespace myoid::inline ground
