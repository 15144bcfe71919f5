#pragma once

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>

#include "tests/support/places.h"

namespace myoid::test {

/// Expects that a page of the documentation holds what the program prints, between the lines
///   <!-- printed: NAME --> and <!-- end of NAME -->.
/// With MYOID_PRINT_PAGES set in the environment the page is written instead.
inline void expect_printed(const std::string& page, const std::string& name, const std::string& printed) {
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

/// Expects that the text of `print(limits)` tells every number of a struct of numbers: it changes
/// each 8 bytes of the struct in turn, a number by its factor and an integer by one.
template <typename Limits, typename Print>
void expect_all_printed(const Print& print) {
  static_assert(std::is_trivially_copyable_v<Limits> && sizeof(Limits) % sizeof(double) == 0);
  const std::string usual = print(Limits{});
  for (std::size_t at = 0; at < sizeof(Limits); at += sizeof(double)) {
    Limits limits;
    char* const place = reinterpret_cast<char*>(&limits) + at;
    double value = 0.0;
    std::memcpy(&value, place, sizeof value);
    if (std::abs(value) > 1e-100) {
      value *= 0.83;
      std::memcpy(place, &value, sizeof value);
    } else {
      ++*place;
    }
    EXPECT_NE(print(limits), usual) << "the text does not tell number " << at / sizeof(double);
  }
}

}  // namespace myoid::test
