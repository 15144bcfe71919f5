// A header is complete in itself, and somebody tests it.
#include <algorithm>
#include <filesystem>
#include <fstream>
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

/// No test includes these; each with the reason. A missing test is a visible hole: this is the list
/// of the holes, and it may only become shorter.
const std::map<std::string, std::string> kWithoutTest = {
    {"myoid/program/cli/command_help.h", "exercised by running the program"},
    {"myoid/program/cli/context.h", "the program's options, exercised by running the program"},
    {"myoid/program/cli/help_files.h", "exercised by running the program"},
    {"myoid/program/cli/option_checks.h", "exercised by running the program"},
    {"myoid/program/cli/options.h", "exercised by running the program"},
    {"myoid/program/cli/run.h", "exercised by running the program"},
    {"myoid/program/cli/wrong_line.h", "exercised by running the program"},
    {"myoid/program/commands/prediction_input.h", "exercised by running the program"},
    {"myoid/ground/core/prior.h", "a plain value, exercised by the estimators"},
    {"myoid/ground/core/stretch.h", "a plain value, exercised by the estimators"},
    {"myoid/ground/files/event.h", "a plain value, exercised by the readers"},
    {"myoid/recording/tables/marker_file.h", "a plain value, exercised by the readers"},
    {"myoid/recording/c3d/c3d_header.h", "exercised by c3d_layout.test"},
    {"myoid/recording/tables/storage_header.h", "exercised by storage.test"},
    {"myoid/fit/posterior/likelihood_block.h", "a plain value, exercised by likelihood.test"},
    {"myoid/fit/intervals/result.h", "values only; exercised by torque.test"},
    {"myoid/body/model/opensim_defects/compat.h", "switches, exercised by muscle_path.test and the OpenSim table"},
    {"myoid/opensim/tool_result.h", "plain values, exercised by run_tool.test"},
    {"myoid/study/phases/phases.h", "plain values, exercised by find_phases.test"},
    {"myoid/results/realtime/c_interface.h", "the C interface, exercised by examples/realtime"},
    {"myoid/results/realtime/read_predictor.h", "exercised by examples/realtime on a finished run"},
    {"myoid/body/osim/osim_update_parts.h", "a part of the updater, tested as part of osim_updater"},
    {"myoid/program/cli/say.h", "exercised by running the program"},
    {"myoid/body/kinematics/ik_options.h", "plain values, exercised by pose_fit.test"},
    {"myoid/recording/angle_file.h", "exercised by the tests of info and check"},
    {"myoid/recording/edf_header.h", "exercised by edf_reader.test"},
    {"myoid/recording/recorded_trial.h", "a plain value, exercised by recording.test"},
    {"myoid/run/study_validation.h", "exercised by run_study.test"},
    {"myoid/study/equal_stretches.h", "exercised by trial_table.test"},
    {"myoid/body/kinematics/lumped_muscles.h", "exercised by design_study.test"},
    {"myoid/run/design/movement.h", "exercised by design_study.test"},
    {"myoid/results/phases_report.h", "words and drawings, seen by running the program"},
};

std::vector<fs::path> files_below(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> result;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
    if (entry.path().filename().string().ends_with(ending)) {
      result.push_back(fs::relative(entry.path(), kRoot));
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// What a file includes, in its order: `<path>` or `"path"`.
std::vector<std::string> includes(const fs::path& file) {
  std::ifstream stream(kRoot / file);
  std::vector<std::string> result;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("#include ")) result.push_back(line.substr(9));
  }
  return result;
}

std::string quoted(const fs::path& header) { return '"' + header.generic_string() + '"'; }

/// The header's own source or test, or the one that the build generates (see CMakeLists.txt),
/// begins with it: that it compiles there is the proof that it needs nothing before it.
TEST(Headers, EveryHeaderIsTheFirstThingThatSomeSourceIncludes) {
  const std::string generated = MYOID_HEADERS_ALONE;
  for (const fs::path& header : files_below("myoid", ".h")) {
    bool first = generated.find(header.generic_string() + ",") != std::string::npos;
    for (const char* ending : {".cpp", ".test.cpp"}) {
      const fs::path source = fs::path(header).replace_extension(ending);
      if (!fs::exists(kRoot / source)) continue;
      const auto included = includes(source);
      first = first || (!included.empty() && included.front() == quoted(header));
    }
    EXPECT_TRUE(first) << header << ": let its .cpp or its .test.cpp include it first, or name it in "
                       << "tests/architecture/CMakeLists.txt";
  }
}

TEST(Headers, EveryHeaderIsIncludedByATestOrTheReasonIsGiven) {
  std::set<std::string> tested;
  for (const char* folder : {"myoid", "tests"}) {
    for (const fs::path& test : files_below(folder, ".test.cpp")) {
      for (const std::string& include : includes(test)) tested.insert(include);
    }
  }
  for (const fs::path& header : files_below("myoid", ".h")) {
    EXPECT_TRUE(tested.contains(quoted(header)) || kWithoutTest.contains(header.generic_string()))
        << header << " is included by no test: write " << fs::path(header).replace_extension(".test.cpp");
  }
}

TEST(Headers, EveryReasonForAMissingTestIsStillNeeded) {
  std::set<std::string> tested;
  for (const char* folder : {"myoid", "tests"}) {
    for (const fs::path& test : files_below(folder, ".test.cpp")) {
      for (const std::string& include : includes(test)) tested.insert(include);
    }
  }
  for (const auto& [header, reason] : kWithoutTest) {
    EXPECT_TRUE(fs::exists(kRoot / header)) << header << " does not exist: strike it from the list";
    EXPECT_FALSE(tested.contains('"' + header + '"')) << header << " has a test: strike it from the list";
  }
}

/// Code that only its own tests call costs every reader and serves no user.
TEST(Headers, EveryHeaderHasAReaderInTheProgram) {
  std::map<std::string, std::set<std::string>> readers;
  for (const char* ending : {".h", ".cpp"}) {
    for (const fs::path& file : files_below("myoid", ending)) {
      if (file.filename().string().ends_with(".test.cpp")) continue;
      for (const std::string& include : includes(file)) readers[include].insert(file.generic_string());
    }
  }
  for (const fs::path& header : files_below("myoid", ".h")) {
    if (header == "myoid/results/realtime/c_interface.h") continue;  // other languages read it
    std::set<std::string> others = readers[quoted(header)];
    others.erase(fs::path(header).replace_extension(".cpp").generic_string());
    EXPECT_FALSE(others.empty()) << header << " is included by no other file of the program";
  }
}

TEST(Headers, EveryTestIsBuilt) {
  for (const fs::path& test : files_below("myoid", ".test.cpp")) {
    const fs::path room = folder_of(room_of(test.generic_string()));
    const std::string list = content(kRoot / room / "CMakeLists.txt");
    std::string unit = test.lexically_relative(room).generic_string();
    unit.resize(unit.size() - std::string(".test.cpp").size());
    EXPECT_TRUE(std::regex_search(list, std::regex("\\s" + unit + "(\\s|\\))")))
        << test << " is not in the CMakeLists.txt of its folder";
  }
}

/// The fuzz targets are built by clang 14 (Debian 12), which does not compile the views of libstdc++ 12.
TEST(Headers, NoSourceTakesTheStandardsViews) {
  for (const char* ending : {".h", ".cpp"}) {
    for (const fs::path& file : files_below("myoid", ending)) {
      const auto included = includes(file);
      EXPECT_EQ(std::ranges::count(included, "<ranges>"), 0) << file << ": see myoid/ground/core/names.h";
    }
  }
}

/// fmt 11 (Fedora) declares fmt::join in this header alone.
TEST(Headers, EverySourceThatJoinsWordsTakesTheirHeader) {
  for (const char* ending : {".h", ".cpp"}) {
    for (const fs::path& file : files_below("myoid", ending)) {
      std::ifstream stream(kRoot / file);
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      if (text.find("fmt::join(") == std::string::npos) continue;
      EXPECT_NE(text.find("#include <fmt/ranges.h>"), std::string::npos) << file << " needs <fmt/ranges.h>";
    }
  }
}

TEST(Headers, EveryHeaderIsGuarded) {
  for (const fs::path& header : files_below("myoid", ".h")) {
    std::ifstream stream(kRoot / header);
    std::string first_line;
    std::getline(stream, first_line);
    EXPECT_EQ(first_line, "#pragma once") << header;
  }
}

}  // namespace
}  // namespace myoid::architecture
