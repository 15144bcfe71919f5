// The first command of a new user.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/files/quoted_text.h"
#include "myoid/ground/files/result_names.h"

#include "browser.h"
#include "program.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using testing::HasSubstr;

TEST(Demo, AnswersInAtMost25LinesAndItsIntervalsHoldTheTruth) {
  const myoid::test::TemporaryFolder folder;
  const Finished demo = myoid({"demo", "--no-open", "--out", folder / "first look"});
  ASSERT_EQ(demo.exit_code, 0) << demo.err;
  EXPECT_LE(std::ranges::count(demo.out, '\n'), 25) << demo.out;
  EXPECT_THAT(demo.out, HasSubstr("The recording passed every question."));
  EXPECT_THAT(demo.out, HasSubstr("Biceps, greatest torque"));
  EXPECT_THAT(demo.out, HasSubstr("Record next: "));
  EXPECT_THAT(demo.out, HasSubstr("No trial has a warning."));
  EXPECT_THAT(demo.err, testing::AllOf(HasSubstr("\nreads the recordings ... "), HasSubstr("\nfits the muscles ... ")));
  EXPECT_TRUE(std::filesystem::exists(folder / "first look/result/report.html"));
  EXPECT_TRUE(std::filesystem::exists(folder / "first look/recording/truth.csv"));
  // The list that protects a user's own files, and the names of trials, knows every file of a run.
  std::vector<std::string> unknown;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "first look/result")) {
    const std::string name = entry.path().filename().string();
    const bool listed = std::ranges::find(myoid::result_names(), name) != myoid::result_names().end();
    if (entry.is_regular_file() && !listed && !name.ends_with("_identified.osim")) unknown.push_back(name);
  }
  EXPECT_THAT(unknown, testing::IsEmpty());
  const std::filesystem::path page = folder / "first look/result/report.html";
  EXPECT_LE(std::filesystem::file_size(page), 3'000'000U);
  if (myoid::test::there_is("chromium")) {
    myoid::test::Browser browser(1280, 900);
    browser.open("file://" + myoid::url_path(page.string()));
    const std::string paper = browser.pdf();
    const std::regex sheet(R"(/Type\s*/Page\b)");
    EXPECT_LE(std::distance(std::sregex_iterator(paper.begin(), paper.end(), sheet), std::sregex_iterator()), 12);
    EXPECT_THAT(browser.complaints(), testing::IsEmpty());
  }
  std::smatch held;
  ASSERT_TRUE(
      std::regex_search(demo.out, held, std::regex(R"(Of (\d+)\s+numbers\s+with\s+a\s+known\s+truth\s+(\d+))")));
  // 95 % intervals: of 70 independent ones fewer than 60 would hold with a probability of 0.1 %.
  EXPECT_GE(std::stod(held[2]), 0.857 * std::stod(held[1])) << demo.out;

  const Finished again = myoid({"demo", "--no-open", "--out", folder / "first look"});
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_THAT(again.err, HasSubstr("--overwrite"));
}

}  // namespace
