#include "myoid/identification/estimate_remarks.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace myoid::identification {
namespace {

ParameterEstimate routes(const std::string& parameter, double narrow, double wide) {
  ParameterEstimate e;
  e.muscle = "BIC";
  e.parameter = parameter;
  e.routes = {{"sandwich", 1.0 - narrow, 1.0 + narrow}, {"cluster", 1.0 - wide, 1.0 + wide}};
  return e;
}

TEST(RouteRemarks, SayOnceWhichNumbersDisagreeAndByHowMuchAtMost) {
  RouteRemarks remarks;
  std::vector<ParameterEstimate> estimates{routes("a", 0.1, 0.14), routes("b", 0.1, 0.2),
                                           routes("c", 0.1, 0.35), routes("d", 1e-300, 1e200)};
  for (ParameterEstimate& e : estimates) remarks.compare(e);
  EXPECT_FALSE(estimates[0].routes_disagree);
  EXPECT_TRUE(estimates[1].routes_disagree);
  std::vector<std::string> lines;
  remarks.add_to(lines, estimates.size());
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("3 of 4 numbers, most for BIC d"), std::string::npos) << lines[0];
  EXPECT_NE(lines[0].find("over 100"), std::string::npos) << lines[0];
  EXPECT_LT(lines[0].size(), 250U);
}

TEST(RouteRemarks, SayOnceWhichProfilesAreOpen) {
  RouteRemarks remarks;
  for (const char* name : {"a", "b", "c", "d", "e", "f"}) {
    ParameterEstimate e = routes(name, 0.1, 0.1);
    e.routes.push_back({"profile", 0.9, {}});
    remarks.compare(e);
  }
  std::vector<std::string> lines;
  remarks.add_to(lines, 8);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("6 of 8 numbers (BIC a, BIC b, BIC c, BIC d, ...)"), std::string::npos)
      << lines[0];
}

TEST(AgreeOnTied, TheWorstVerdictIsThatOfAll) {
  const auto owner = [](const char* muscle, const char* tied_to, Verdict verdict) {
    ParameterEstimate e;
    e.muscle = muscle;
    e.tied_to = tied_to;
    e.verdict = verdict;
    e.reason = muscle;
    return e;
  };
  std::vector<ParameterEstimate> estimates{
      owner("X", "", Verdict::identified), owner("BIC", "", Verdict::identified),
      owner("BRA", "BIC", Verdict::weak), owner("TRI", "BIC", Verdict::identified)};
  agree_on_tied(estimates, 3);
  EXPECT_EQ(estimates[0].verdict, Verdict::identified);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(estimates[i].verdict, Verdict::weak) << i;
    EXPECT_EQ(estimates[i].reason, "BRA") << i;
  }
}

TEST(PriorDistances, AboveThreeMakeALineThatNamesTheMuscleAndTheFarthestNumber) {
  std::vector<std::string> lines;
  add_distances_to(
      lines, {{"BIC", 2.9, "force_length_width", 2.0}, {"TRI", 1.0, "max_isometric_force", 3.4}});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].find("TRI has left"), 0U) << lines[0];
  EXPECT_NE(lines[0].find("max_isometric_force 3.4"), std::string::npos) << lines[0];
}

TEST(DistanceFromPrior, CountsInSpreadsOfWhatTheSolverSees) {
  FreeParameter strength;
  strength.prior_mean = std::log(1000.0);
  strength.prior_sd = 0.25;
  EXPECT_NEAR(distance_from_prior(strength, std::log(400.0)), std::log(2.5) / 0.25, 1e-12);
  EXPECT_NEAR(distance_from_prior(strength, std::log(2500.0)), std::log(2.5) / 0.25, 1e-12);
}

}  // namespace
}  // namespace myoid::identification
