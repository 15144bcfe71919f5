#include "myoid/ground/files/label_match.h"

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

using Map = std::map<std::string, std::string>;

TEST(MatchLabels, CapitalsBlanksAndPrefixesDoNotMatter) {
  const LabelMatch match = match_labels({"Joe:R.Shoulder", "r elbow", "wrist"}, {"r_shoulder", "R_ELBOW", "wrist"});
  EXPECT_EQ(match.same, (Map{{"Joe:R.Shoulder", "r_shoulder"}, {"r elbow", "R_ELBOW"}}));
}

TEST(MatchLabels, WhereTwoFitNoneIsTaken) {
  EXPECT_TRUE(match_labels({"r elbow", "R-Elbow"}, {"r_elbow"}).same.empty());
  EXPECT_TRUE(match_labels({"relbow"}, {"r_elbow", "R_ELBOW"}).same.empty());
}

TEST(MatchLabels, NamesThatMerelyResembleEachOtherAreNoPair) {
  EXPECT_TRUE(match_labels({"r_elbwo", "T1", "head"}, {"r_elbow", "c1", "C7"}).same.empty());
}

}  // namespace
}  // namespace myoid::inline ground
