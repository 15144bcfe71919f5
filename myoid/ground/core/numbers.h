#pragma once

#include <limits>

namespace myoid::inline ground {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();  ///< No bound.
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();      ///< No value.

}  // namespace myoid::inline ground
