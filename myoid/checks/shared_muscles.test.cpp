#include "myoid/checks/shared_muscles.h"

#include <gtest/gtest.h>

namespace myoid {
namespace {

Study two(const std::string& osim, const std::string& emg) {
  Study study;
  study.muscles = {{.name = "BIC", .osim = {"BIClong", "BICshort"}, .emg = "Biceps"},
                   {.name = "TRI", .osim = {osim}, .emg = emg}};
  return study;
}

TEST(SharedMuscles, OfMusclesOfTheirOwnNothingIsSaid) {
  EXPECT_TRUE(shared_muscles(two("TRIlong", "Triceps")).empty());
}

TEST(SharedMuscles, AMuscleOfTheModelInTwoTablesIsAnError) {
  const auto found = shared_muscles(two("BICshort", "Triceps"));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::error);
  EXPECT_NE(found[0].says.find("'BICshort'"), std::string::npos) << found[0].says;
}

TEST(SharedMuscles, AChannelOfTwoMusclesIsAWarningUnlessItIsMeant) {
  Study study = two("TRIlong", "Biceps");
  const auto found = shared_muscles(study);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_NE(found[0].says.find("same_as = \"BIC\""), std::string::npos) << found[0].says;
  study.muscles[1].same_as = "BIC";
  EXPECT_TRUE(shared_muscles(study).empty());
}

}  // namespace
}  // namespace myoid
