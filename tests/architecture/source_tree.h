#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace myoid::architecture {

namespace fs = std::filesystem;

inline const fs::path kRoot = MYOID_SOURCE_DIR;

inline std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace myoid::architecture
