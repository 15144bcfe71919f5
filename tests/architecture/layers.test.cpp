// An architecture nobody checks is a drawing: every #include of the library is compared with the
// list in cmake/layers.cmake.
#include <algorithm>
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

/// Layer by name: the layers that it may use, from cmake/layers.cmake.
std::map<std::string, std::set<std::string>> allowed_layers() {
  const std::string text = content(kRoot / "cmake" / "layers.cmake");
  const std::regex entry(R"(set\(MYOID_LAYER_(\w+)\s*([^)]*)\))");
  std::map<std::string, std::set<std::string>> result;
  for (std::sregex_iterator it(text.begin(), text.end(), entry), end; it != end; ++it) {
    std::set<std::string>& allowed = result[(*it)[1]];
    for (const std::string& word : words((*it)[2])) {
      if (word.starts_with("${MYOID_LAYER_")) {
        const auto& other = result.at(word.substr(14, word.size() - 15));
        allowed.insert(other.begin(), other.end());
      } else {
        allowed.insert(word);
      }
    }
  }
  return result;
}

struct SourceFile {
  fs::path path;
  std::string layer;
  std::string text;
};

/// Headers and sources of the library and the program, without tests.
std::vector<SourceFile> sources() {
  std::vector<SourceFile> result;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "myoid")) {
    const fs::path& path = entry.path();
    const std::string file = path.filename().string();
    if (path.extension() != ".h" && path.extension() != ".cpp") continue;
    if (file.ends_with(".test.cpp")) continue;
    const fs::path relative = fs::relative(path, kRoot);
    result.push_back({relative, room_of(relative.generic_string()), content(path)});
  }
  std::sort(result.begin(), result.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return result;
}

TEST(Architecture, TheListOfLayersIsRead) {
  const auto layers = allowed_layers();
  EXPECT_GT(layers.size(), 20U);
  EXPECT_TRUE(layers.at("core").empty());
  EXPECT_TRUE(layers.at("cli").contains("commands"));
  EXPECT_TRUE(layers.at("cli").contains("page"));
}

TEST(Architecture, EveryIncludeReachesIntoALayerThatIsAllowed) {
  const auto layers = allowed_layers();
  const std::regex include(R"re(#include "(myoid/[^"]*)")re");
  int seen = 0;
  for (const SourceFile& source : sources()) {
    ASSERT_TRUE(layers.contains(source.layer)) << source.path << ": no such layer in cmake/layers.cmake";
    for (std::sregex_iterator it(source.text.begin(), source.text.end(), include), end; it != end; ++it) {
      const std::string target = room_of((*it)[1]);
      EXPECT_TRUE(target == source.layer || layers.at(source.layer).contains(target))
          << source.path << " includes " << target << ", which " << source.layer << " may not use";
      ++seen;
    }
  }
  EXPECT_GT(seen, 100);  // that the pattern still finds them
}

TEST(Architecture, TheLayersHaveNoCircle) {
  const auto layers = allowed_layers();
  for (const auto& [layer, uses] : layers) {
    for (const std::string& used : uses) {
      ASSERT_TRUE(layers.contains(used)) << layer << " uses " << used;
      EXPECT_FALSE(layers.at(used).contains(layer)) << layer << " and " << used;
    }
  }
}

/// Wings by the wings that their rooms use.
std::map<std::string, std::set<std::string>> wings_used() {
  std::map<std::string, std::set<std::string>> used;
  for (const auto& [room, allowed] : allowed_layers())
    for (const std::string& other : allowed)
      if (wings().at(other) != wings().at(room)) used[wings().at(room)].insert(wings().at(other));
  return used;
}

/// Twelve names for a newcomer to hold, each the only name of its floor's subject, and no two that need each other.
TEST(Architecture, TwelveWingsHaveNoCircle) {
  std::set<std::string> names;
  for (const auto& [room, wing] : wings()) names.insert(wing);
  EXPECT_EQ(names.size(), 12U);
  for (const auto& [room, allowed] : allowed_layers()) EXPECT_TRUE(wings().contains(room)) << room;
  std::map<std::string, std::set<std::string>> used = wings_used();
  std::size_t before = 0;
  for (std::size_t size = 1; size != before;) {  // the closure
    before = size;
    size = 0;
    for (auto& [wing, others] : used) {
      for (const std::string& other : std::set<std::string>(others))
        others.insert(used[other].begin(), used[other].end());
      size += others.size();
    }
  }
  for (const auto& [wing, others] : used) EXPECT_FALSE(others.contains(wing)) << wing;
}

/// Identification knows no file and no skeleton.
TEST(Architecture, TheFitKnowsMusclesAndGroundAlone) {
  EXPECT_EQ(wings_used().at("fit"), (std::set<std::string>{"ground", "muscle"}));
}

/// The namespace of a file is its wing; a namespace below may follow. Other languages see extern "C" alone.
TEST(Architecture, TheFolderIsTheNamespace) {
  const std::regex any(R"(\nnamespace (myoid[\w: ]*) \{)");
  for (const SourceFile& source : sources()) {
    const std::string wing = wings().at(source.layer);
    for (std::sregex_iterator it(source.text.begin(), source.text.end(), any), end; it != end; ++it) {
      const std::string name = (*it)[1];
      EXPECT_TRUE(name == "myoid::" + wing || name.starts_with("myoid::" + wing + "::") ||
                  name.starts_with("myoid::inline " + wing))
          << source.path << " opens " << name;
    }
  }
}

/// A list that allows more than the sources use hides the shape of the house.
TEST(Architecture, EveryLayerThatIsListedIsUsed) {
  const std::regex include(R"re(#include "(myoid/[^"]*)")re");
  std::map<std::string, std::set<std::string>> used;
  for (const SourceFile& source : sources()) {
    for (std::sregex_iterator it(source.text.begin(), source.text.end(), include), end; it != end; ++it)
      used[source.layer].insert(room_of((*it)[1]));
  }
  for (const auto& [layer, allowed] : allowed_layers()) {
    for (const std::string& other : allowed)
      EXPECT_TRUE(used[layer].contains(other)) << layer << " does not use " << other;
  }
}

/// A room that grows beyond these bounds is two rooms.
TEST(Architecture, NoRoomHoldsTheHouse) {
  const std::set<std::string> large = {"model"};
  std::map<std::string, std::ptrdiff_t> lines;
  std::ptrdiff_t all = 0;
  for (const SourceFile& source : sources()) {
    const std::ptrdiff_t count = std::count(source.text.begin(), source.text.end(), '\n');
    lines[source.layer] += count;
    all += count;
  }
  for (const auto& [layer, count] : lines) {
    EXPECT_LT(100 * count, 12 * all) << layer << " has " << count << " of " << all << " lines";
    if (large.contains(layer)) continue;
    EXPECT_LE(count, 5500) << layer;
  }
}

/// Units (a header and its source) by the units that they include.
std::map<std::string, std::set<std::string>> units() {
  const std::regex include(R"re(#include "(myoid/[^"]*)")re");
  const auto unit = [](const std::string& file) {
    return std::regex_replace(file, std::regex(R"((_inl)?\.(h|cpp)$)"), "");
  };
  std::map<std::string, std::set<std::string>> result;
  for (const SourceFile& source : sources()) {
    const std::string from = unit(source.path.generic_string());
    for (std::sregex_iterator it(source.text.begin(), source.text.end(), include), end; it != end; ++it) {
      const std::string to = unit((*it)[1]);
      if (to != from) result[from].insert(to);
    }
  }
  return result;
}

std::set<std::string> reached_from(const std::string& start, const std::map<std::string, std::set<std::string>>& uses) {
  std::set<std::string> reached;
  std::vector<std::string> open{start};
  while (!open.empty()) {
    const std::string unit = open.back();
    open.pop_back();
    const auto used = uses.find(unit);
    if (used == uses.end()) continue;
    for (const std::string& next : used->second) {
      if (reached.insert(next).second) open.push_back(next);
    }
  }
  return reached;
}

/// Units that all reach each other can only be understood together. The bound may only become smaller.
TEST(Architecture, NoKnotOfUnitsIsLarge) {
  constexpr std::size_t kLargest = 3;
  const auto uses = units();
  std::map<std::string, std::set<std::string>> reach;
  for (const auto& [unit, used] : uses) reach[unit] = reached_from(unit, uses);
  std::size_t largest = 0;
  for (const auto& [unit, reached] : reach) {
    std::vector<std::string> knot;
    for (const std::string& other : reached) {
      if (reach.contains(other) && reach.at(other).contains(unit)) knot.push_back(other);
    }
    largest = std::max(largest, knot.size());
    std::string names;
    for (const std::string& name : knot) names += ' ' + name;
    EXPECT_LE(knot.size(), kLargest) << "these include each other in a circle:" << names;
  }
  EXPECT_EQ(largest, kLargest) << "the largest knot became smaller: lower the bound";
}

TEST(Architecture, OnlyTheProgramPrints) {
  const std::regex printing(R"(std::cout|std::cerr|std::clog|\bprintf\(|fmt::print\()");
  for (const SourceFile& source : sources()) {
    if (source.layer == "cli") continue;
    EXPECT_FALSE(std::regex_search(source.text, printing)) << source.path;
  }
}

// nlohmann's dump() throws for a name that is no UTF-8; json_text does not. A parser takes 2 s to compile.
TEST(Architecture, JsonIsRenderedAndParsedInOnePlace) {
  for (const SourceFile& source : sources()) {
    if (source.path.filename() == "json_text.cpp") continue;
    EXPECT_EQ(source.text.find(".dump("), std::string::npos) << source.path << ": json_text renders JSON";
    EXPECT_EQ(source.text.find("json::parse("), std::string::npos) << source.path << ": parse_json parses JSON";
  }
}

TEST(Architecture, OnlyReadersWritersAndTheTopTouchFiles) {
  const std::set<std::string> rooms = {"files", "tables", "c3d", "recording", "page", "results", "run", "cli"};
  const std::set<std::string> doors = {"myoid/ground/core/build_identity.cpp", "myoid/run/design/earlier_run.cpp"};
  for (const SourceFile& source : sources()) {
    if (rooms.contains(source.layer) || doors.contains(source.path.generic_string())) continue;
    EXPECT_EQ(source.text.find("#include <fstream>"), std::string::npos) << source.path;
  }
}

TEST(Architecture, NothingIsDrawnWithoutASeed) {
  const std::regex unseeded(R"(std::random_device|\brand\(\)|\bsrand\(|Eigen::\w+::Random)");
  for (const SourceFile& source : sources()) {
    EXPECT_FALSE(std::regex_search(source.text, unseeded)) << source.path;
  }
}

TEST(Architecture, EveryHeaderIsListedForItsTarget) {
  for (const SourceFile& source : sources()) {
    const std::string list = content(kRoot / folder_of(source.layer) / "CMakeLists.txt");
    const fs::path unit = source.path.lexically_relative(folder_of(source.layer));
    std::string name = std::regex_replace(unit.generic_string(), std::regex(R"((_inl)?\.\w+$)"), "");
    if (source.layer == "cli") name = unit.filename().string();
    EXPECT_TRUE(std::regex_search(list, std::regex("(^|\\s)" + name + "(\\s|\\)|$)")))
        << source.path << " is not in the CMakeLists.txt of its folder";
  }
}

TEST(Architecture, EveryRoomHasAGroupInTheApiReference) {
  const std::string groups = content(kRoot / "docs" / "api" / "rooms.dox");
  std::set<std::string> found;
  const std::regex group(R"(@defgroup (\w+) \w)");
  for (std::sregex_iterator it(groups.begin(), groups.end(), group), end; it != end; ++it) found.insert((*it)[1]);
  std::set<std::string> rooms;
  for (const auto& [room, allowed] : allowed_layers()) rooms.insert(room);
  rooms.erase("cli");  // the program is no library
  EXPECT_EQ(found, rooms);
}

}  // namespace
}  // namespace myoid::architecture
