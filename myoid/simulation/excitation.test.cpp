#include "myoid/simulation/excitation.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/core/error.h"

namespace myoid::simulation {
namespace {

TEST(Excitation, IsLinearBetweenItsNodesAndHeldBeyondThem) {
  const Signal s{{1.0, 2.0, 4.0}, {0.0, 1.0, 0.5}};
  EXPECT_EQ(value_at(s, 0.0), 0.0);
  EXPECT_EQ(value_at(s, 1.5), 0.5);
  EXPECT_EQ(value_at(s, 3.0), 0.75);
  EXPECT_EQ(value_at(s, 9.0), 0.5);
  EXPECT_TRUE(jumps(s, 0.0, 10.0).empty());
}

TEST(Excitation, ABurstJumpsUpAndDown) {
  const Burst list[] = {{1.0, 0.5, 0.8}, {3.0, 1.0, 0.4}};
  const Signal s = bursts(list, 0.1);
  EXPECT_EQ(value_at(s, 0.9), 0.1);
  EXPECT_EQ(value_at(s, 1.0), 0.8);  // the right side of a jump
  EXPECT_EQ(value_at(s, 1.5), 0.1);
  EXPECT_EQ(value_at(s, 3.5), 0.4);
  EXPECT_THAT(jumps(s, 0.0, 3.5), testing::ElementsAre(1.0, 1.5, 3.0));
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

}  // namespace
}  // namespace myoid::simulation
