#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>

#include "myoid/core/error.h"

namespace myoid::fuzz {

inline std::span<const std::byte> bytes(const std::uint8_t* data, std::size_t size) {
  return std::as_bytes(std::span(data, size));
}

inline std::string_view text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Runs a reader: a value or a ReadError, nothing else. Other exceptions end the run.
template <typename Reader>
void read(Reader&& reader) {
  try {
    reader();
  } catch (const ReadError&) {
  }
}

/// What must hold, also in an optimized build.
inline void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace myoid::fuzz
