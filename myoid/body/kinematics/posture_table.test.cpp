#include "myoid/body/kinematics/posture_table.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::body {
namespace {

/// A marker on a circle of 1 m, and one that stands still: postures are the angle, a degree apart.
PostureTable circle() {
  Eigen::MatrixXd postures(360, 1), places = Eigen::MatrixXd::Zero(360, 6);
  for (Eigen::Index i = 0; i < 360; ++i) {
    const double angle = static_cast<double>(i) * kPi / 180.0;
    postures(i, 0) = angle;
    places.row(i).head(3) << std::cos(angle), std::sin(angle), 0.0;
  }
  return {postures, places};
}

TEST(PostureTable, TheNearestPostureIsTheOnlyMinimumOfACircle) {
  const PostureTable table = circle();
  const auto minima = table.minima({{Vec3(0.0, 1.5, 0.2), 1.0}, {Vec3(0.3, 0.0, 0.0), 1.0}}, 8);
  ASSERT_EQ(minima.size(), 1U);
  EXPECT_EQ(minima.front(), 90);
  EXPECT_NEAR(table.posture(minima.front())[0], 0.5 * kPi, 1e-12);
}

TEST(PostureTable, AMarkerThatWasNotSeenDoesNotCount) {
  const PostureTable table = circle();
  EXPECT_EQ(table.minima({{Vec3(-1.0, 0.0, 0.0), 2.0}, {Vec3(1e6, 0.0, 0.0), 0.0}}, 1).front(), 180);
}

TEST(PostureTable, EachOfTwoMinimaIsFoundTheBetterOneFirst) {
  // The curve cos 2a over the angle a: from above at a height of -1, its lowest points are at 90 and 270 degrees.
  Eigen::MatrixXd postures(72, 1), places(72, 3);
  for (Eigen::Index i = 0; i < 72; ++i) {
    const double angle = static_cast<double>(i) * kPi / 36.0;
    postures(i, 0) = angle;
    places.row(i) << std::cos(angle), std::sin(angle), std::cos(2.0 * angle);
  }
  const PostureTable table(postures, places);
  const auto minima = table.minima({{Vec3(0.0, 0.1, -3.0), 1.0}}, 8);
  ASSERT_EQ(minima.size(), 2U);
  EXPECT_EQ(minima[0], 18);
  EXPECT_EQ(minima[1], 54);
}

}  // namespace
}  // namespace myoid::body
