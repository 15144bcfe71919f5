#include "tests/support/places.h"

#include <cstdlib>

namespace myoid::test {

std::filesystem::path source_dir() { return MYOID_SOURCE_DIR; }

std::filesystem::path data_folder() {
  if (const char* folder = std::getenv("MYOID_DATA")) return folder;
  return source_dir() / ".." / "shared" / "data";
}

}  // namespace myoid::test
