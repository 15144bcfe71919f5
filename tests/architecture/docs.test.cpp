// Documentation that leads nowhere, or leaves a command out, is noticed.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/architecture/source_tree.h"

namespace myoid::architecture {
namespace {

std::vector<fs::path> pages() {
  std::vector<fs::path> result{kRoot / "README.md", kRoot / "CHANGELOG.md", kRoot / "CONTRIBUTING.md",
                               kRoot / "SECURITY.md"};
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs")) {
    if (entry.path().extension() == ".md") result.push_back(entry.path());
  }
  return result;
}

TEST(Documentation, EveryLinkLeadsToAFile) {
  const std::regex link(R"(\]\(([^)#\s]*)(#[^)]*)?\))");
  int seen = 0;
  for (const fs::path& page : pages()) {
    const std::string text = content(page);
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
      const std::string target = (*it)[1];
      if (target.empty() || target.starts_with("http")) continue;
      EXPECT_TRUE(fs::exists(page.parent_path() / target)) << page << " points to " << target;
      ++seen;
    }
  }
  EXPECT_GT(seen, 20);  // that the pattern still finds them
}

/// Returns true for the path of a file or folder, from the root or from myoid/, with or without its ending.
bool is_source(const std::string& path) {
  for (const fs::path& from : {kRoot, kRoot / "myoid"})
    for (const char* ending : {"", ".h", ".cpp", ".test.cpp"})
      if (fs::exists(from / (path + ending))) return true;
  return false;
}

TEST(Documentation, EverySourceThatAPageNamesIsThere) {
  std::string folders = "myoid|tests|docs|cmake|examples|python|benchmarks";
  for (const auto& entry : fs::directory_iterator(kRoot / "myoid"))
    if (entry.is_directory()) folders += "|" + entry.path().filename().string();
  const std::regex path("`((?:" + folders + ")/[a-z_0-9/.-]+)`");
  int seen = 0;
  for (const fs::path& page : pages()) {
    const std::string text = content(page);
    for (std::sregex_iterator it(text.begin(), text.end(), path), end; it != end; ++it) {
      EXPECT_TRUE(is_source((*it)[1])) << page << " names " << (*it)[1];
      ++seen;
    }
  }
  EXPECT_GT(seen, 40);
}

std::size_t word_count(const std::string& text) {
  std::istringstream stream(text);
  std::size_t count = 0;
  for (std::string word; stream >> word;) ++count;
  return count;
}

/// What a page asks of its reader.
struct PageWords {
  std::size_t all = 0;           ///< Words as `wc -w` counts them.
  std::size_t by_hand = 0;       ///< Without the tables that the program prints.
  std::size_t longest_cell = 0;  ///< Words of the longest cell of a table.
  std::string longest_row;
};

PageWords words_of(const std::string& text) {
  PageWords result;
  bool printed = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("<!-- printed: ")) printed = true;
    if (line.starts_with("<!-- end of ")) printed = false;
    result.all += word_count(line);
    if (!printed) result.by_hand += word_count(line);
    if (!line.starts_with('|')) continue;
    std::string cell;
    for (std::size_t i = 1; i < line.size(); ++i) {
      if (line[i] != '|' || line[i - 1] == '\\') {
        cell += line[i];
        continue;
      }
      if (word_count(cell) > result.longest_cell) {
        result.longest_cell = word_count(cell);
        result.longest_row = line;
      }
      cell.clear();
    }
  }
  return result;
}

TEST(Documentation, WordsAreCounted) {
  const PageWords words = words_of(
      "# A page\n"
      "| option | meaning |\n"
      "| `a\\|b` | three words here |\n"
      "<!-- printed: it -->\n"
      "| one | a b c d e |\n"
      "<!-- end of it -->\n");
  EXPECT_EQ(words.all, 33U);
  EXPECT_EQ(words.by_hand, 20U);
  EXPECT_EQ(words.longest_cell, 5U);
  EXPECT_EQ(words.longest_row, "| one | a b c d e |");
}

/// Ratchets: these numbers only ever go down, and no page joins the exceptions, whose long cells the program prints.
constexpr std::size_t kMostWords = 60'000, kMostOfAPage = 2'500, kMostOfACell = 25;
const std::map<std::string, std::size_t> kLongCells{{"identify.md", 28}, {"study.md", 40}, {"twin.md", 29}};

std::size_t limit_of(const fs::path& page, const std::map<std::string, std::size_t>& exceptions, std::size_t usual) {
  const auto it = exceptions.find(page.filename().string());
  return it == exceptions.end() ? usual : it->second;
}

TEST(Documentation, IsShort) {
  std::size_t all = 0;
  for (const fs::path& page : pages()) {
    if (page.parent_path() == kRoot) continue;  // README.md, CHANGELOG.md, CONTRIBUTING.md, SECURITY.md
    const PageWords words = words_of(content(page));
    all += words.all;
    EXPECT_LE(words.by_hand, kMostOfAPage) << page << ": split it, or use fewer words";
    EXPECT_LE(words.longest_cell, limit_of(page, kLongCells, kMostOfACell)) << page << ": " << words.longest_row;
  }
  EXPECT_GT(all, 10'000U);
  EXPECT_LE(all, kMostWords) << "words of docs/*.md: shorten a page; history goes to commits and decisions";
}

TEST(Documentation, PicturesAreSmallAndShown) {
  std::string all;
  for (const fs::path& page : pages()) all += content(page);
  int seen = 0;
  for (const auto& entry : fs::directory_iterator(kRoot / "docs" / "figures")) {
    if (entry.path().extension() != ".webp") continue;
    const bool film = entry.path().filename() == "film.webp";
    EXPECT_LT(fs::file_size(entry.path()), film ? 1'000'000U : 200'000U) << entry.path();
    EXPECT_NE(all.find("figures/" + entry.path().filename().string()), std::string::npos)
        << entry.path() << " is on no page";
    ++seen;
  }
  EXPECT_GT(seen, 5);
  EXPECT_LT(fs::file_size(kRoot / "docs" / "sample.html"), 3'000'000U);
}

/// The keys are those of the Citation File Format 1.2.0; four of them must be there.
TEST(Documentation, TheCitationFileIsValid) {
  const std::set<std::string> known{"abstract",
                                    "authors",
                                    "cff-version",
                                    "commit",
                                    "contact",
                                    "date-released",
                                    "doi",
                                    "identifiers",
                                    "keywords",
                                    "license",
                                    "license-url",
                                    "message",
                                    "preferred-citation",
                                    "references",
                                    "repository",
                                    "repository-artifact",
                                    "repository-code",
                                    "title",
                                    "type",
                                    "url",
                                    "version"};
  const std::string text = content(kRoot / "CITATION.cff");
  const std::regex key(R"((?:^|\n)([a-z-]+):)");
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), key), end; it != end; ++it) {
    EXPECT_TRUE(found.insert((*it)[1]).second) << "twice: " << (*it)[1];
    EXPECT_TRUE(known.contains((*it)[1])) << (*it)[1];
  }
  for (const char* required : {"authors", "cff-version", "message", "title"})
    EXPECT_TRUE(found.contains(required)) << required;
  EXPECT_NE(text.find("cff-version: 1.2.0\n"), std::string::npos);
  const std::string built = content(kRoot / "CMakeLists.txt"), before = "project(myoid VERSION ";
  const std::size_t at = built.find(before) + before.size();
  const std::string version = built.substr(at, built.find(' ', at) - at);
  EXPECT_NE(text.find("\nversion: " + version + "\n"), std::string::npos) << version;
}

/// The text of every source of the program, the parts of each literal joined.
std::string messages_of_the_program() {
  const std::regex seam(R"("\s*\n\s*")");
  std::string all;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "myoid")) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".cpp") && !name.ends_with(".test.cpp"))
      all += std::regex_replace(content(entry.path()), seam, "");
  }
  return all;
}

TEST(Documentation, EveryMessageOfTheTroubleshootingPageIsOneOfTheProgram) {
  const std::string page = content(kRoot / "docs" / "guide" / "troubleshooting.md");
  const std::string said = messages_of_the_program();
  const std::string table = page.substr(0, page.find("| what happens |"));
  const std::regex message(R"(\n\| `([^`]+)` \|)");
  int seen = 0;
  for (std::sregex_iterator it(table.begin(), table.end(), message), end; it != end; ++it) {
    EXPECT_NE(said.find((*it)[1].str()), std::string::npos) << "no message holds: " << (*it)[1];
    ++seen;
  }
  EXPECT_GT(seen, 10);
}

std::set<std::string> commands_of_the_program() {
  const std::regex subcommand(R"re((?:add_subcommand\(|add_command<\w+>\(\s*app, context,)\s*"([\w-]+)")re");
  std::set<std::string> commands;
  for (const auto& entry : fs::directory_iterator(kRoot / "myoid" / "program" / "cli")) {
    const std::string text = content(entry.path());
    for (std::sregex_iterator it(text.begin(), text.end(), subcommand), end; it != end; ++it) {
      commands.insert((*it)[1]);
    }
  }
  return commands;
}

TEST(Documentation, EveryCommandHasItsPage) {
  const std::set<std::string> commands = commands_of_the_program();
  EXPECT_TRUE(commands.contains("run"));
  for (const std::string& command : commands) {
    const std::string page = content(kRoot / "docs" / "guide" / (command + ".md"));
    EXPECT_TRUE(page.starts_with("# myoid " + command)) << "docs/guide/" << command << ".md";
  }
}

TEST(Documentation, NoPageAndNoMessageNamesACommandThatIsNone) {
  std::set<std::string> commands = commands_of_the_program();
  // Words that --help does not list: another way to ask for it, and the packages' own.
  commands.insert({"help", "help-files"});
  const std::regex named(R"re([`(']myoid ([a-z][a-z-]*))re");
  std::vector<fs::path> files = pages();
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "myoid")) {
    if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h") files.push_back(entry.path());
  }
  int seen = 0;
  for (const fs::path& file : files) {
    const std::string text = content(file);
    for (std::sregex_iterator it(text.begin(), text.end(), named), end; it != end; ++it) {
      EXPECT_TRUE(commands.contains((*it)[1])) << file << " names 'myoid " << (*it)[1] << "'";
      ++seen;
    }
  }
  EXPECT_GT(seen, 50);
}

/// The option that a command's source adds beside those of its `visit`: in its page.
TEST(Documentation, EveryOptionOfACommandIsInItsPage) {
  const std::regex option(R"re(add_(?:option|flag|flag_callback)\(\s*"(--[\w-]+)")re");
  int seen = 0;
  for (const auto& entry : fs::directory_iterator(kRoot / "myoid" / "program" / "cli")) {
    const std::string text = content(entry.path());
    if (text.find("void add_") == std::string::npos || entry.path().stem() == "context") continue;
    std::string command = entry.path().stem().string();  // twin_study.cpp is twin-study
    std::replace(command.begin(), command.end(), '_', '-');
    const fs::path page = kRoot / "docs" / "guide" / (command + ".md");
    const std::string explained = content(page);
    for (std::sregex_iterator it(text.begin(), text.end(), option), end; it != end; ++it) {
      EXPECT_NE(explained.find((*it)[1].str()), std::string::npos) << page << " leaves out " << (*it)[1];
      ++seen;
    }
  }
  EXPECT_GT(seen, 5);
}

}  // namespace
}  // namespace myoid::architecture
