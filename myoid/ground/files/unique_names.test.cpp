#include "myoid/ground/files/unique_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

std::vector<std::string> given(const std::vector<std::string>& names) {
  UniqueNames unique(names);
  std::vector<std::string> result;
  for (const std::string& name : names) result.push_back(unique.take(name));
  return result;
}

TEST(UniqueNames, ALaterEqualNameIsNumberedAndTakesNoOtherNameOfTheList) {
  EXPECT_THAT(given({"a", "b", "a", "a"}), testing::ElementsAre("a", "b", "a_2", "a_3"));
  EXPECT_THAT(given({"a", "a", "a_2", "a"}), testing::ElementsAre("a", "a_3", "a_2", "a_4"));
  EXPECT_THAT(given({"a_2", "a_2", "a", "a"}), testing::ElementsAre("a_2", "a_2_2", "a", "a_3"));
}

TEST(UniqueNames, ASubjectIsLeftOutWhereNoTwoNamesBecomeOne) {
  const auto left = [](std::vector<std::string> names, std::size_t notes) {
    std::vector<Repair> repairs;
    leave_out_subject(names, 3, repairs);
    EXPECT_EQ(repairs.size(), notes);
    return names;
  };
  EXPECT_THAT(left({"P:KNE", "P:ANK", "TOE"}, 1), testing::ElementsAre("KNE", "ANK", "TOE"));
  EXPECT_THAT(left({"P:KNE", "Q:KNE"}, 1), testing::ElementsAre("P:KNE", "Q:KNE"));
  EXPECT_THAT(left({"KNE", ":ANK", "TOE:"}, 0), testing::ElementsAre("KNE", ":ANK", "TOE:"));
}

/// A search from 2 on for each name would try 60,000 * 60,000 / 2 names.
TEST(UniqueNames, TheWorkGrowsWithTheNumberOfNames) {
  std::vector<std::string> names(60000, "HEAD");
  for (int k = 0; k < 30000; ++k) names[static_cast<std::size_t>(2 * k)] = "HEAD_" + std::to_string(k);
  UniqueNames unique(names);
  std::set<std::string> result;
  for (const std::string& name : names) result.insert(unique.take(name));
  EXPECT_EQ(result.size(), names.size());
  EXPECT_LE(unique.trials(), 4 * names.size());
}

}  // namespace
}  // namespace myoid::inline ground
