#pragma once

#include <cstddef>

namespace myoid {

/// An index as Eigen and the models count (signed, never negative here) as an index of the standard
/// containers: `bodies[at(k)]`.
[[nodiscard]] constexpr std::size_t at(std::ptrdiff_t index) {
  return static_cast<std::size_t>(index);
}

}  // namespace myoid
