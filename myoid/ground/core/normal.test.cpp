#include "myoid/ground/core/normal.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

TEST(Normal, NineteenOfTwentyNumbersLieWithinTheInterval) {
  EXPECT_NEAR(std::erf(kNormal95 / std::numbers::sqrt2), 0.95, 1e-14);
}

TEST(Normal, TheSpreadOfRectifiedNoiseIsThatOfAHalfNormalDistribution) {
  // Mean sqrt(2/pi), variance 1 - 2/pi; the constant has four digits.
  EXPECT_NEAR(kRectifiedSpread, std::sqrt((1.0 - 2.0 / std::numbers::pi) * std::numbers::pi / 2.0), 5e-5);
}

}  // namespace
}  // namespace myoid::inline ground
