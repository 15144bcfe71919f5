#include "myoid/recording/amplifier_range.h"

#include <limits>

#include <gtest/gtest.h>

namespace myoid::recording {
namespace {

TEST(AmplifierRange, IsLeftByMoreThanOneSampleInAHundredAndNotByAnArtifact) {
  Eigen::VectorXd x = Eigen::VectorXd::Constant(1000, 9.9);
  x.head(10).setConstant(-11.0);
  EXPECT_FALSE(is_beyond_amplifiers(x));
  x[10] = 1e6;
  EXPECT_TRUE(is_beyond_amplifiers(x));
  EXPECT_FALSE(is_beyond_amplifiers(1e-6 * x));
}

TEST(AmplifierRange, MissingSamplesCountNeitherWay) {
  Eigen::VectorXd x = Eigen::VectorXd::Constant(1000, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(is_beyond_amplifiers(x));
  x[0] = 50.0;
  EXPECT_TRUE(is_beyond_amplifiers(x));
}

}  // namespace
}  // namespace myoid::recording
