// Measures of the house that may only become better: each is counted here, printed, and compared with its limit. Lower
// the limit with the number.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/architecture/source_tree.h"

namespace myoid::architecture {
namespace {

struct Source {
  std::string path, text;
};

/// Returns the sources of a folder; of the program (`tests` false), or the tests.
std::vector<Source> sources_of(const fs::path& folder, bool tests) {
  std::vector<Source> found;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
    const std::string file = entry.path().filename().string();
    const bool is_test = file.ends_with(".test.cpp");
    if ((file.ends_with(".h") || file.ends_with(".cpp")) && is_test == tests)
      found.push_back({fs::relative(entry.path(), kRoot).generic_string(), content(entry.path())});
  }
  std::sort(found.begin(), found.end(), [](const Source& a, const Source& b) { return a.path < b.path; });
  return found;
}

const std::vector<Source>& program() {
  static const std::vector<Source> kSources = sources_of("myoid", false);
  return kSources;
}

std::ptrdiff_t count(const std::string& text, const std::regex& what) {
  return std::distance(std::sregex_iterator(text.begin(), text.end(), what), std::sregex_iterator());
}

/// Facts lead to a finding and a finding to a verdict in one file; others copy a verdict or spell it.
TEST(Measures, OneFileMakesVerdicts) {
  const std::regex made(R"(\w(\.|->)verdict\s*=[^=]|[^=!<>]=\s*(fit::)?Verdict::|return\s+(fit::)?Verdict::)");
  std::set<std::string> makers;
  for (const Source& source : program())
    if (count(source.text, made) > 0) makers.insert(source.path);
  EXPECT_EQ(makers, (std::set<std::string>{"myoid/fit/intervals/result.h",  // the verdict before any
                                           "myoid/fit/intervals/verdicts.cpp",
                                           "myoid/results/cohort/group_person.h"}));  // and before a table is read
}

/// Lines of the rooms that identify, docstrings and blank lines included.
TEST(Measures, TheRoomsThatIdentifyShrink) {
  const std::set<std::string> rooms{"beliefs", "measurement", "intervals", "methods", "posterior"};
  std::map<std::string, std::ptrdiff_t> lines;
  std::ptrdiff_t all = 0;
  for (const Source& source : program()) {
    const std::string room = room_of(source.path);
    if (!rooms.contains(room)) continue;
    const std::ptrdiff_t here = std::count(source.text.begin(), source.text.end(), '\n');
    lines[room] += here;
    all += here;
  }
  for (const auto& [room, count_of] : lines) std::cout << room << " " << count_of << "\n";
  std::cout << "together " << all << " (asked: 10500)\n";
  EXPECT_LE(all, 12830);
}

/// An enumeration stays one: a word is compared only where text is read, as in a model file or a table.
TEST(Measures, EnumerationsAreNotComparedAsWords) {
  const std::regex word(R"(\b(method|verdict|lag|folds|fit_case|scales|criterion|use)\s*[!=]=\s*")");
  const std::set<std::string> reads{"osim", "opensim", "arm", "recording", "dynamics"};
  std::map<std::string, std::ptrdiff_t> found;
  std::ptrdiff_t all = 0;
  for (const Source& source : program()) {
    const std::ptrdiff_t here = reads.contains(room_of(source.path)) ? 0 : count(source.text, word);
    if (here > 0) found[source.path] = here;
    all += here;
  }
  std::cout << "enumerations compared as words " << all << " (asked: 0)\n";
  EXPECT_EQ(all, 0) << testing::PrintToString(found);
}

/// No branch depends on the words of a sentence that the program itself wrote.
TEST(Measures, NoBranchReadsASentence) {
  const std::regex sentence(R"re(\b(starts_with|ends_with|find|contains)\(\s*"[^"]*[a-z]+ [a-z]+ [^"]*")re");
  for (const Source& source : program()) EXPECT_EQ(count(source.text, sentence), 0) << source.path;
}

/// Remarks of results are ground/core/remark.h's, which have a code; a loose list of sentences has none.
TEST(Measures, LooseListsOfSentencesBecomeFewer) {
  const std::regex list(
      R"(std::vector<std::string>\s+(notes|warnings|remarks|messages|hints|findings|diagnoses|undetermined|sentences)\b[^(;]*;)");
  std::ptrdiff_t all = 0;
  for (const Source& source : program())
    if (source.path.ends_with(".h")) all += count(source.text, list);
  std::cout << "loose lists of sentences " << all << "\n";
  EXPECT_EQ(all, 0);
}

/// A test asserts codes and values; a text only where the text is the product.
TEST(Measures, AssertionsOnSentencesBecomeFewer) {
  // Three words in one literal; what a call throws or reads is no assertion on its text.
  const std::regex sentence(R"re("[^"\n]*[A-Za-z]+,? [a-z]+,? [a-z]+[^"\n]*")re"),
      call("(EXPECT|ASSERT)_(NO_)?(ANY_)?THROW");
  std::ptrdiff_t all = 0;
  for (const char* folder : {"myoid", "tests"}) {
    for (const Source& source : sources_of(folder, true)) {
      std::size_t at = 0;
      while (at < source.text.size()) {
        at = std::min(source.text.find("EXPECT_", at), source.text.find("ASSERT_", at));
        if (at == std::string::npos) break;
        const std::size_t end = source.text.find(";\n", at);
        const std::string one = source.text.substr(at, end - at);
        const std::string asserted = one.substr(0, one.find(") <<"));
        all += std::regex_search(asserted, sentence) && !std::regex_search(asserted, call) ? 1 : 0;
        at = end == std::string::npos ? source.text.size() : end;
      }
    }
  }
  std::cout << "assertions on sentences " << all << " (asked: below 400)\n";
  EXPECT_LE(all, 338);
}

/// The members of a struct or class at its own depth: what ends with a semicolon or an initializer and is no function.
std::size_t fields_of(const std::string& body) {
  std::size_t fields = 0;
  int depth = 0;
  std::string statement;
  const auto ended = [&] {
    static const std::regex kOther(
        R"(^\s*(public|private|protected|using|enum|struct|class|static|friend|template|explicit|virtual|\[\[nodiscard\]\]))");
    static const std::regex kTemplate(R"(<[^<>]*>)");
    if (!statement.empty() && !std::regex_search(statement, kOther)) {
      for (std::string shorter; (shorter = std::regex_replace(statement, kTemplate, "")) != statement;)
        statement = shorter;
      if (statement.find('(') == std::string::npos && statement.find_first_not_of(" \n") != std::string::npos)
        fields += 1 + static_cast<std::size_t>(std::count(statement.begin(), statement.end(), ','));
    }
    statement.clear();
  };
  for (const char c : body) {
    if (c == '{') ++depth;
    if (c == '}') {
      --depth;
      // A function's body ends its statement; an initializer goes on to the semicolon.
      if (depth == 0 && statement.find('(') != std::string::npos) statement.clear();
      continue;
    }
    if (depth > 0) continue;
    if (c == ';') {
      ended();
    } else if (c != '{') {
      statement += c;
    }
  }
  return fields;
}

TEST(Measures, FieldsAreCounted) {
  EXPECT_EQ(fields_of("double a = 1.0, b = 2.0;\n std::map<int, int> c;\n int d() const { return 1; }\n E e{};"), 4U);
}

/// Struct by name and its number of fields, of the structs above 20.
std::map<std::string, std::size_t> large_structs() {
  const std::regex comment(R"(//[^\n]*)"), text(R"re("(\\.|[^"\\])*")re"),
      head(R"(\b(struct|class)\s+([\w:]+)[^;{()]*\{)");
  std::map<std::string, std::size_t> large;
  for (const Source& source : program()) {
    const std::string code = std::regex_replace(std::regex_replace(source.text, comment, ""), text, "\"\"");
    for (std::sregex_iterator it(code.begin(), code.end(), head), end; it != end; ++it) {
      const auto begin = static_cast<std::size_t>(it->position() + it->length());
      std::size_t at = begin;
      for (int depth = 1; depth > 0 && at < code.size(); ++at) depth += code[at] == '{' ? 1 : code[at] == '}' ? -1 : 0;
      const std::size_t fields = fields_of(code.substr(begin, at - begin - 1));
      if (fields > 20) large[(*it)[2]] = fields;
    }
  }
  return large;
}

TEST(Measures, NoStructHasMoreThanTwentyFields) {
  const std::map<std::string, std::size_t> large = large_structs();
  EXPECT_TRUE(large.empty()) << testing::PrintToString(large);
}

}  // namespace
}  // namespace myoid::architecture
