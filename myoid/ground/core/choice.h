#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace myoid::inline ground {

/// The names of an enumeration's values, in the order of the enumerators, as files and options
/// write them. An enumeration that has names declares beside itself
///   constexpr ChoiceNames choice_names(Enumeration);
/// and the table there is the only place where these words stand.
using ChoiceNames = std::span<const std::string_view>;

/// Returns the name of an enumerator.
template <typename Enumeration>
[[nodiscard]] constexpr std::string_view choice_name(Enumeration value) {
  return choice_names(value)[static_cast<std::size_t>(value)];
}

/// Returns the enumerator of this name; empty if none has it.
template <typename Enumeration>
[[nodiscard]] constexpr std::optional<Enumeration> choice_named(std::string_view word) {
  const ChoiceNames names = choice_names(Enumeration{});
  const auto found = std::find(names.begin(), names.end(), word);
  if (found == names.end()) return std::nullopt;
  return static_cast<Enumeration>(found - names.begin());
}

}  // namespace myoid::inline ground
