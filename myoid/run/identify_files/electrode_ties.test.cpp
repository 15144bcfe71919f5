#include "myoid/run/identify_files/electrode_ties.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace myoid::run {
namespace {

fit::MuscleSetup muscle(const char* name, const char* channel) {
  fit::MuscleSetup setup;
  setup.name = name;
  setup.emg_channel = channel;
  return setup;
}

TEST(ElectrodeTies, MusclesOfOneElectrodeShareEveryScaleUnlessTheyHaveTheirOwn) {
  std::vector<fit::MuscleSetup> muscles{muscle("BIClong", "BIC"), muscle("TRI", "TRI"), muscle("BICshort", "BIC"),
                                        muscle("BRA", "BIC")};
  muscles[3].fixed.push_back("optimal_fiber_length");
  const ElectrodeTies ties = electrode_ties(muscles);
  const auto owners = [&](const char* parameter) {
    const auto rule = std::ranges::find(ties.rules, parameter, &fit::ParameterRule::parameter);
    return rule == ties.rules.end() ? std::vector<std::string>() : rule->owners;
  };
  EXPECT_EQ(owners("max_isometric_force"), (std::vector<std::string>{"BIClong", "BICshort", "BRA"}));
  EXPECT_EQ(owners("optimal_fiber_length"), (std::vector<std::string>{"BIClong", "BICshort"}));
  EXPECT_TRUE(owners("tendon_slack_length").empty());
  for (const fit::ParameterRule& rule : ties.rules) EXPECT_TRUE(rule.tie);
  EXPECT_NE(ties.says.find("'BIC' 3 muscles"), std::string::npos) << ties.says;
  EXPECT_TRUE(electrode_ties({muscle("BIC", "BIC"), muscle("TRI", "TRI")}).rules.empty());
}

}  // namespace
}  // namespace myoid::run
