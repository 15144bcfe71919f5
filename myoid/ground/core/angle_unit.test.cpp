#include "myoid/ground/core/angle_unit.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::inline ground {
namespace {

TimeSeries angles(double first_rad, double last_rad, Unit unit = Unit::radian) {
  return {Eigen::Vector2d(0.0, 1.0), {{"knee", unit}}, Eigen::Vector2d(first_rad, last_rad)};
}

TEST(AngleUnit, DegreesThatAreCalledRadiansAreRefused) {
  EXPECT_THROW((void)check_angle_unit("m.mot", false, angles(5.0, 60.0)), ReadError);
  EXPECT_EQ(check_angle_unit("m.mot", false, angles(0.1, 1.2)), "");
  // Lengths may be of any size, and a crank that says degrees may turn often.
  EXPECT_EQ(check_angle_unit("m.mot", false, angles(5.0, 60.0, Unit::meter)), "");
  EXPECT_EQ(check_angle_unit("m.mot", true, angles(0.0, 60.0)), "");
}

TEST(AngleUnit, RadiansThatAreCalledDegreesAreDoubted) {
  EXPECT_THAT(check_angle_unit("m.mot", true, angles(0.1 * kDegree, 1.2 * kDegree)), ::testing::HasSubstr("'knee'"));
  // An elbow that bends from 3.3 to 13.2 degrees has such radians.
  EXPECT_NE(check_angle_unit("m.mot", true, angles(0.058 * kDegree, 0.23 * kDegree)), "");
  // A posture that hardly moves may be what it says.
  EXPECT_EQ(check_angle_unit("m.mot", true, angles(0.0 * kDegree, 0.01 * kDegree)), "");
  EXPECT_EQ(check_angle_unit("m.mot", true, angles(1.0 * kDegree, 1.1 * kDegree)), "");
}

TEST(AngleUnit, OfManyAnglesOneOrTheOtherMayCountTurns) {
  const auto doubted = [](Eigen::Index large) {
    std::vector<Channel> channels;
    Eigen::MatrixXd values(2, 20);
    for (Eigen::Index c = 0; c < 20; ++c) {
      channels.push_back({"q" + std::to_string(c), Unit::radian});
      values.col(c) << 0.1 * kDegree, (c < large ? 6.2 : 1.2) * kDegree;
    }
    return !check_angle_unit("m.mot", true, {Eigen::Vector2d(0.0, 1.0), channels, values}).empty();
  };
  EXPECT_TRUE(doubted(0));
  EXPECT_TRUE(doubted(2));
  EXPECT_FALSE(doubted(3));
}

}  // namespace
}  // namespace myoid::inline ground
