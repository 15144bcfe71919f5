#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include <unistd.h>

#include "myoid/ground/core/error.h"

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

/// A line between two files of one input.
inline constexpr std::string_view kNextFile = "\n%%%%\n";

/// A folder of this process, in TMPDIR (a RAM disk is best), for readers that open files.
inline const std::filesystem::path& folder() {
  static const std::filesystem::path path = [] {
    auto made = std::filesystem::temp_directory_path() / ("myoid_fuzz_" + std::to_string(::getpid()));
    std::filesystem::create_directories(made);
    return made;
  }();
  return path;
}

inline void write(const std::string& name, std::string_view content) {
  std::ofstream(folder() / name, std::ios::binary) << content;
}

/// Writes the parts of the input as these files; a part that is not there is an empty file.
inline void write_parts(std::string_view input, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    const std::size_t end = input.find(kNextFile);
    write(name, input.substr(0, end));
    input = end == std::string_view::npos ? "" : input.substr(end + kNextFile.size());
  }
}

}  // namespace myoid::fuzz
