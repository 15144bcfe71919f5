#pragma once

#include <functional>
#include <string>

namespace myoid::inline ground {

/// Returns "a, b, c" for a message: of the items, or of each item's `name` (a member or a function of it).
/// The standard's views do the same, but clang 14 does not compile those of libstdc++ 12.
template <typename Items, typename Name = std::identity>
[[nodiscard]] std::string name_list(const Items& items, Name name = {}) {
  std::string text;
  for (const auto& item : items) {
    if (!text.empty()) text += ", ";
    text += std::invoke(name, item);
  }
  return text;
}

}  // namespace myoid::inline ground
