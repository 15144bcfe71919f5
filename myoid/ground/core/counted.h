#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace myoid::inline ground {

/// Returns a number with its noun: "1 file", "2 files". The plural is the noun and an s.
[[nodiscard]] inline std::string counted(std::size_t count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

}  // namespace myoid::inline ground
