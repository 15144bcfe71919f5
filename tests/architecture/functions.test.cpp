// Functions that fit a screen: the formatted sources show where each begins and ends.
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/architecture/source_tree.h"

namespace myoid::architecture {
namespace {

struct Function {
  std::string place;  ///< "myoid/lab/virtual_person/protocol.cpp:207"
  std::size_t lines = 0;
};

/// Finds the functions that begin at a depth of indentation: a head with parentheses that opens a
/// brace, to the first closing brace at the same depth.
void add_functions(const std::string& file,
                   const std::vector<std::string>& lines,
                   std::size_t depth,
                   std::vector<Function>& found) {
  static const std::regex kOther(
      R"(\s*(namespace|struct|class|enum|union|extern|if|for|while|switch|else|do|try|case|return)\b.*)");
  static const std::regex kEndOfOther(R"(.*[;{}:]\s*|\s*//.*|\s*|#.*)");
  const std::string indent(depth, ' ');
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i].ends_with('{')) continue;
    std::size_t first = i;  // the head may have several lines
    while (first > 0 && !std::regex_match(lines[first - 1], kEndOfOther)) --first;
    const bool here = lines[first].starts_with(indent) && lines[first].size() > depth && lines[first][depth] != ' ' &&
                      !std::regex_match(lines[first], kOther);
    std::string head;
    for (std::size_t k = first; k <= i; ++k) head += lines[k];
    static const std::regex kTable(R"(\s*(inline |static )*(constexpr|const) [^(]* = .*)");
    if (!here || head.find('(') == std::string::npos || std::regex_match(head, kTable)) continue;
    std::size_t last = i + 1;
    while (last < lines.size() && !lines[last].starts_with(indent + "}")) ++last;
    found.push_back({file + ":" + std::to_string(first + 1), last - first + 1});
    i = last;
  }
}

std::vector<Function> functions_of(const std::string& file, const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  std::vector<Function> found;
  add_functions(file, lines, 0, found);
  add_functions(file, lines, 2, found);  // inside a class
  return found;
}

TEST(Functions, AreFoundWithTheirLines) {
  const std::vector<Function> found = functions_of("a.cpp",
                                                   "namespace a {\n"
                                                   "int one(int x,\n"
                                                   "        int y) {\n"
                                                   "  if (x > y) {\n"
                                                   "    return x;\n"
                                                   "  }\n"
                                                   "  return y;\n"
                                                   "}\n"
                                                   "struct B {\n"
                                                   "  void two() {\n"
                                                   "    one(1, 2);\n"
                                                   "  }\n"
                                                   "};\n"
                                                   "}\n");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].place, "a.cpp:2");
  EXPECT_EQ(found[0].lines, 7U);
  EXPECT_EQ(found[1].place, "a.cpp:10");
  EXPECT_EQ(found[1].lines, 3U);
}

TEST(Functions, AreAtMost100LinesAndFewAreAbove60) {
  std::size_t all = 0;
  std::vector<std::string> above_60;
  for (const char* folder : {"myoid", "python/src"}) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      const fs::path& path = entry.path();
      if ((path.extension() != ".h" && path.extension() != ".cpp") || path.string().ends_with(".test.cpp")) continue;
      for (const Function& function : functions_of(fs::relative(path, kRoot).string(), content(path))) {
        ++all;
        EXPECT_LE(function.lines, 100U) << function.place;
        if (function.lines > 60) above_60.push_back(function.place + " " + std::to_string(function.lines));
      }
    }
  }
  EXPECT_GT(all, 4000U);
  EXPECT_LT(above_60.size(), 30U) << testing::PrintToString(above_60);
}

}  // namespace
}  // namespace myoid::architecture
