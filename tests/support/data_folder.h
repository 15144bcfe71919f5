#pragma once

#include <cstdlib>
#include <filesystem>

namespace myoid::test {

/// Folder of the shared real recordings; they are not part of the project. Tests that need them
/// skip, saying so, when `file` is not there:  MYOID_REQUIRE_DATA(path)
inline std::filesystem::path data_folder() {
  if (const char* folder = std::getenv("MYOID_DATA")) return folder;
  return std::filesystem::path(MYOID_SOURCE_DIR) / ".." / "shared" / "data";
}

}  // namespace myoid::test

/// Skips the running test when the shared data set lacks `path`.
#define MYOID_REQUIRE_DATA(path)                                                          \
  do {                                                                                    \
    if (!std::filesystem::exists(path)) {                                                 \
      GTEST_SKIP() << "needs " << (path) << "; set MYOID_DATA to the shared data folder"; \
    }                                                                                     \
  } while (false)
