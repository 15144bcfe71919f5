#include "myoid/ground/math/bounded.h"

#include <cmath>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

namespace myoid::inline ground::math {
namespace {

TEST(Bounded, SlopePullAndCurvatureAreTheDerivatives) {
  constexpr double kStep = 1e-4;
  for (double x = -3.5; x <= 3.5; x += 0.1) {
    const Bounded at = bounded(x), above = bounded(x + kStep), below = bounded(x - kStep);
    EXPECT_NEAR(at.slope, (above.share - below.share) / (2.0 * kStep), 1e-7) << x;
    EXPECT_NEAR(at.log_slope, std::log(at.slope), 1e-12) << x;
    EXPECT_NEAR(at.pull, (above.log_slope - below.log_slope) / (2.0 * kStep), 1e-6) << x;
    EXPECT_NEAR(at.curvature, -(above.pull - below.pull) / (2.0 * kStep), 1e-5) << x;
    EXPECT_NEAR(unbounded(at.share), x, 1e-9) << x;
  }
}

TEST(Bounded, IsALineBetweenTheBoundsAndStaysWithinThem) {
  for (const double share : {0.2, 0.4, 0.5, 0.7}) {
    EXPECT_NEAR(bounded(4.0 * (share - 0.5)).share, share, 1e-3);
    EXPECT_NEAR(bounded(4.0 * (share - 0.5)).pull, 0.0, 0.1);
  }
  for (const double x : {-39.0, -8.0, 8.0, 39.0}) {
    EXPECT_GE(bounded(x).share, 0.0);
    EXPECT_LE(bounded(x).share, 1.0);
    EXPECT_TRUE(std::isfinite(bounded(x).log_slope));
  }
}

TEST(Bounded, TheDensityOfXIsThatOfTheShare) {
  // The integral of dt/dx over all x is the length of the bounds.
  const auto slope = [](double x) { return bounded(x).slope; };
  EXPECT_NEAR((boost::math::quadrature::gauss_kronrod<double, 61>::integrate(slope, -12.0, 12.0, 10, 1e-12)), 1.0,
              1e-9);
}

}  // namespace
}  // namespace myoid::inline ground::math
