#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/places.h"

namespace myoid::test {

/// Expects that a page of the documentation holds what the program prints, between the lines
///   <!-- printed: NAME --> and <!-- end of NAME -->.
/// With MYOID_PRINT_PAGES set in the environment the page is written instead.
inline void expect_printed(const std::string& page,
                           const std::string& name,
                           const std::string& printed) {
  const std::filesystem::path path = source_dir() / page;
  std::stringstream stream;
  stream << std::ifstream(path).rdbuf();
  std::string text = stream.str();
  const std::string begin = "<!-- printed: " + name + " -->\n";
  const std::string end = "<!-- end of " + name + " -->\n";
  const std::size_t from = text.find(begin), to = text.find(end);
  ASSERT_TRUE(from != std::string::npos && to != std::string::npos && from < to)
      << page << " has no place for " << name;
  const std::size_t first = from + begin.size();
  if (std::getenv("MYOID_PRINT_PAGES") != nullptr) {
    text.replace(first, to - first, printed);
    std::ofstream(path) << text;
    return;
  }
  EXPECT_EQ(text.substr(first, to - first), printed)
      << page << " differs from the program; run this test with MYOID_PRINT_PAGES=1 to print it";
}

}  // namespace myoid::test
