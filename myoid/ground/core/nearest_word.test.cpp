#include "myoid/ground/core/nearest_word.h"

#include <set>

#include <gtest/gtest.h>

namespace myoid {
namespace {

TEST(NearestWord, ForgivesCaseAndOneSlipButNotAnotherWord) {
  EXPECT_EQ(nearest_word("bic", {"BIC", "TRI"}), "BIC");
  EXPECT_EQ(nearest_word("r_elbow_flx", {"r_elbow_flex", "r_shoulder_elev"}), "r_elbow_flex");
  EXPECT_FALSE(nearest_word("banana", {"BIC", "TRI"}).has_value());
}

TEST(NearestWord, ANameThatIsNotThereEndsWithTheNearestAndAllNames) {
  const std::string near = did_you_mean("BIK", {"BIC", "TRI"});
  EXPECT_NE(near.find("'BIC'?"), std::string::npos) << near;
  EXPECT_EQ(did_you_mean("banana", {"BIC", "TRI"}), "");
  const std::string slip = not_among("BIK", {"BIC", "TRI"});
  EXPECT_TRUE(slip.starts_with(near) && slip.ends_with("are BIC, TRI")) << slip;
  EXPECT_EQ(not_among("banana", std::set<std::string>{"BIC"}), "; there are BIC");
  EXPECT_TRUE(not_among("BIC", std::vector<std::string>{}).ends_with("none"));
  const std::string of_many = not_among("banana", std::vector<std::string>(61, "BIC"));
  EXPECT_TRUE(of_many.ends_with("BIC, ...")) << of_many;
}

}  // namespace
}  // namespace myoid
