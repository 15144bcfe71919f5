#include "myoid/simulation/excitation_text.h"

#include <gtest/gtest.h>

#include "myoid/core/error.h"

namespace myoid::simulation {
namespace {

const std::vector<std::string> kMuscles{"BIC", "TRI"};

double at(const std::vector<std::string>& texts, std::size_t muscle, double time_s) {
  return simulation::value_at(described_excitations(texts, 0.01, kMuscles).at(muscle), time_s);
}

TEST(ExcitationText, ALevelAStepAndABurst) {
  EXPECT_EQ(at({"BIC=0.3"}, 0, 5.0), 0.3);
  EXPECT_EQ(at({"BIC=0.3"}, 1, 5.0), 0.01);
  EXPECT_EQ(at({"BIC=0.3@0.2"}, 0, 0.1), 0.01);
  EXPECT_EQ(at({"BIC=0.3@0.2"}, 0, 100.0), 0.3);
  EXPECT_EQ(at({"BIC=0.3@0.2+0.25"}, 0, 0.3), 0.3);
  EXPECT_EQ(at({"BIC=0.3@0.2+0.25"}, 0, 0.5), 0.01);
}

TEST(ExcitationText, AllIsEveryMuscleAndBurstsMayComeInAnyOrder) {
  const std::vector<std::string> texts{"BIC=0.5@2+1", "all=0.05", "BIC=0.2@0+1"};
  EXPECT_EQ(at(texts, 0, 0.5), 0.2);
  EXPECT_EQ(at(texts, 0, 1.5), 0.05);
  EXPECT_EQ(at(texts, 0, 2.5), 0.5);
  EXPECT_EQ(at(texts, 1, 2.5), 0.05);
}

TEST(ExcitationText, WhatIsNoneIsRefused) {
  for (const char* text : {"BIC", "=0.3", "BIC=", "BIC=1.5", "BIC=-0.1", "BIC=nan", "BIC=0.3@", "BIC=0.3@0.2+",
                           "BIC=0.3@0.2+0", "BIC=0.3@0.2+-1", "SOL=0.3"})
    EXPECT_THROW((void)described_excitations({text}, 0.01, kMuscles), InvalidInput) << text;
}

}  // namespace
}  // namespace myoid::simulation
