#include "myoid/files/label_match.h"

#include <gtest/gtest.h>

namespace myoid::recording {
namespace {

using Map = std::map<std::string, std::string>;

TEST(MatchLabels, CapitalsBlanksAndPrefixesDoNotMatter) {
  const LabelMatch match = match_labels({"Joe:R.Shoulder", "r elbow", "wrist"}, {"r_shoulder", "R_ELBOW", "wrist"});
  EXPECT_EQ(match.same, (Map{{"Joe:R.Shoulder", "r_shoulder"}, {"r elbow", "R_ELBOW"}}));
  EXPECT_TRUE(match.similar.empty());
}

TEST(MatchLabels, WhereTwoFitNoneIsTaken) {
  EXPECT_TRUE(match_labels({"r elbow", "R-Elbow"}, {"r_elbow"}).same.empty());
  EXPECT_TRUE(match_labels({"relbow"}, {"r_elbow", "R_ELBOW"}).same.empty());
}

TEST(MatchLabels, AMisspelledNameIsASuggestionOnly) {
  const LabelMatch match = match_labels({"r_elbwo", "C7", "head"}, {"r_elbow", "C7"});
  EXPECT_TRUE(match.same.empty());
  EXPECT_EQ(match.similar, (Map{{"r_elbwo", "r_elbow"}}));
}

}  // namespace
}  // namespace myoid::recording
