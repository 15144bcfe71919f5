#pragma once

#include <cstddef>

namespace myoid::inline ground {

/// Converts a signed index of Eigen or a model, never negative here, to an index of the standard
/// containers: `bodies[at(k)]`.
[[nodiscard]] constexpr std::size_t at(std::ptrdiff_t index) { return static_cast<std::size_t>(index); }

}  // namespace myoid::inline ground
