#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace myoid::architecture {

namespace fs = std::filesystem;

inline const fs::path kRoot = test::source_dir();

inline std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// Wing by room, from cmake/layers.cmake.
inline const std::map<std::string, std::string>& wings() {
  static const std::map<std::string, std::string> kWings = [] {
    const std::string text = content(kRoot / "cmake" / "layers.cmake");
    const std::regex entry(R"(set\(MYOID_WING_(\w+)\s*([^)]*)\))");
    std::map<std::string, std::string> result;
    for (std::sregex_iterator it(text.begin(), text.end(), entry), end; it != end; ++it)
      for (const std::string& room : words((*it)[2])) result[room] = (*it)[1];
    return result;
  }();
  return kWings;
}

/// The room of a file below myoid/ ("myoid/fit/posterior/mode.h": posterior; "myoid/run/run_study.h": run).
inline std::string room_of(const std::string& path) {
  static const std::regex kFolders(R"(^myoid/(\w+)/(?:(\w+)/)?)");
  std::smatch folders;
  if (!std::regex_search(path, folders, kFolders)) return "";
  const auto room = wings().find(folders[2]);
  return room != wings().end() && room->second == folders[1] ? room->first : folders[1].str();
}

inline fs::path folder_of(const std::string& room) {
  const auto wing = wings().find(room);
  if (wing == wings().end()) return fs::path("myoid") / room;
  return room == wing->second ? fs::path("myoid") / room : fs::path("myoid") / wing->second / room;
}

}  // namespace myoid::architecture
