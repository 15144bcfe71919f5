#include "myoid/body/simulation/excitation.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

TEST(Excitation, IsLinearBetweenItsNodesAndHeldBeyondThem) {
  const Signal s{{1.0, 2.0, 4.0}, {0.0, 1.0, 0.5}};
  EXPECT_EQ(value_at(s, 0.0), 0.0);
  EXPECT_EQ(value_at(s, 1.5), 0.5);
  EXPECT_EQ(value_at(s, 3.0), 0.75);
  EXPECT_EQ(value_at(s, 9.0), 0.5);
  EXPECT_TRUE(jumps(s).empty());
}

TEST(Excitation, ABurstJumpsUpAndDown) {
  const Burst list[] = {{1.0, 0.5, 0.8}, {3.0, 1.0, 0.4}};
  const Signal s = bursts(list, 0.1);
  EXPECT_EQ(value_at(s, 0.9), 0.1);
  EXPECT_EQ(value_at(s, 1.0), 0.8);  // the right side of a jump
  EXPECT_EQ(value_at(s, 1.5), 0.1);
  EXPECT_EQ(value_at(s, 3.5), 0.4);
  EXPECT_THAT(jumps(s), testing::ElementsAre(1.0, 1.5, 3.0, 4.0));
  EXPECT_EQ(value_at(step(2.0, 0.7), 2.0), 0.7);
  const Burst overlapping[] = {{1.0, 0.5, 0.8}, {1.2, 1.0, 0.4}};
  EXPECT_THROW((void)bursts(overlapping), InvalidInput);
}

TEST(Excitation, IsFoundAmongTheChannelsOfARecording) {
  const TimeSeries series(Eigen::Vector2d(0.0, 1.0),
                          {{"BRA", Unit::dimensionless}, {"/forceset/BIC/excitation", Unit::dimensionless}},
                          (Eigen::Matrix2d() << 0.1, 0.2, 0.3, 0.4).finished());
  const std::string names[] = {"BIC", "BRA"};
  const auto signals = excitations_from(series, names);
  EXPECT_THAT(signals[0].value, testing::ElementsAre(0.2, 0.4));
  EXPECT_THAT(signals[1].value, testing::ElementsAre(0.1, 0.3));
  const std::string missing[] = {"TRI"};
  try {
    (void)excitations_from(series, missing);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("TRI"), testing::HasSubstr("BRA")));
  }
}

TEST(Excitation, OutOfRangeOrOutOfOrderIsRefusedWithItsPlace) {
  EXPECT_THROW(validate_excitation({{0.0, 1.0}, {0.0, 1.01}}, "x"), InvalidInput);
  EXPECT_THROW(validate_excitation({{0.0}, {-0.01}}, "x"), InvalidInput);
  EXPECT_THROW(validate_excitation({{0.0}, {std::numeric_limits<double>::quiet_NaN()}}, "x"), InvalidInput);
  EXPECT_THROW(validate({{1.0, 0.0}, {0.0, 0.0}}, "x"), InvalidInput);
  EXPECT_THROW(validate({{1.0, 1.0, 1.0}, {0.0, 0.0, 0.0}}, "x"), InvalidInput);
  EXPECT_THROW(validate({}, "x"), InvalidInput);
}

const std::vector<std::string> kMuscles{"BIC", "TRI"};

double at(const std::vector<std::string>& texts, std::size_t muscle, double time_s) {
  return value_at(described_excitations(texts, 0.01, kMuscles).at(muscle), time_s);
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
}  // namespace myoid::body
