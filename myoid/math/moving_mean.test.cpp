#include "myoid/math/moving_mean.h"

#include <gtest/gtest.h>

namespace myoid::math {
namespace {

TEST(MovingMean, AveragesEveryWindowByHand) {
  Eigen::VectorXd x(5);
  x << 1.0, 2.0, 6.0, 4.0, -1.0;
  const Eigen::VectorXd three = moving_mean(x, 3);
  ASSERT_EQ(three.size(), 3);
  EXPECT_NEAR(three[0], 3.0, 1e-15);
  EXPECT_NEAR(three[1], 4.0, 1e-15);
  EXPECT_NEAR(three[2], 3.0, 1e-15);
  EXPECT_TRUE(moving_mean(x, 1).isApprox(x));
}

TEST(MovingMean, TheGreatestIsOverTheWindowOrOverAllThereIs) {
  Eigen::VectorXd x(5);
  x << 1.0, 2.0, 6.0, 4.0, -1.0;
  EXPECT_NEAR(greatest_mean(x, 10.0, 0.2), 5.0, 1e-15);  // two samples: 6 and 4
  EXPECT_NEAR(greatest_mean(x, 10.0, 9.0), 2.4, 1e-15);
  EXPECT_NEAR(greatest_mean(x, 10.0, 0.0), 6.0, 1e-15);
}

}  // namespace
}  // namespace myoid::math
