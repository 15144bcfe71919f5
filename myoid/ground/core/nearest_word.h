#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::inline ground {

/// Returns the candidate nearest to `word` by edit distance if it is near enough for a slip of the pen.
[[nodiscard]] std::optional<std::string> nearest_word(std::string_view word,
                                                      const std::vector<std::string>& candidates);

/// Returns " (did you mean 'BIC'?)"; empty if no candidate is near.
[[nodiscard]] std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// Returns the end of a sentence on a name that is not there: " (did you mean 'BIC'?); there are BIC, TRI".
[[nodiscard]] std::string not_among(std::string_view word, const std::vector<std::string>& names);

/// Likewise of a set, or of the names of objects.
template <typename Items, typename Name = std::identity>
[[nodiscard]] std::string not_among(std::string_view word, const Items& items, Name name = {}) {
  std::vector<std::string> names;
  for (const auto& item : items) names.emplace_back(std::invoke(name, item));
  return not_among(word, names);
}

}  // namespace myoid::inline ground
