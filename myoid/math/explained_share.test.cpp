#include "myoid/math/explained_share.h"

#include <gtest/gtest.h>

namespace myoid::math {
namespace {

TEST(ExplainedShare, IsOneMinusTheErrorsShareOfTheVariance) {
  // Residuals 1, 0, -1; deviations from the mean -3, 0, 3.
  EXPECT_DOUBLE_EQ(explained_share(Eigen::Vector3d(2, 4, 6), Eigen::Vector3d(1, 4, 7)), 1.0 - 2.0 / 18.0);
  EXPECT_LT(explained_share(Eigen::Vector3d(7, 4, 1), Eigen::Vector3d(1, 4, 7)), 0.0);
}

TEST(ExplainedShare, OfAConstantIsAboutZero) {
  EXPECT_DOUBLE_EQ(explained_share(Eigen::Vector2d(9, 11), Eigen::Vector2d(10, 10)), 0.99);
  EXPECT_EQ(explained_share(Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()), 1.0);
}

}  // namespace
}  // namespace myoid::math
