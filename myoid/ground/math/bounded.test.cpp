#include "myoid/ground/math/bounded.h"

#include <cmath>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

namespace myoid::inline ground::math {
namespace {

class BothShapes : public testing::TestWithParam<BoundShape> {};
INSTANTIATE_TEST_SUITE_P(Bounded, BothShapes, testing::Values(BoundShape::gradual, BoundShape::sharp));

TEST_P(BothShapes, SlopePullAndCurvatureAreTheDerivatives) {
  constexpr double kStep = 1e-4;
  const auto of = [&](double x) { return bounded(x, GetParam()); };
  for (double x = -3.5; x <= 3.5; x += 0.1) {
    const Bounded at = of(x), above = of(x + kStep), below = of(x - kStep);
    EXPECT_NEAR(at.slope, (above.share - below.share) / (2.0 * kStep), 1e-7) << x;
    EXPECT_NEAR(at.log_slope, std::log(at.slope), 1e-12) << x;
    EXPECT_NEAR(at.pull, (above.log_slope - below.log_slope) / (2.0 * kStep), 1e-6) << x;
    EXPECT_NEAR(at.curvature, -(above.pull - below.pull) / (2.0 * kStep), 1e-5) << x;
    EXPECT_NEAR(unbounded(at.share, GetParam()), x, 1e-9) << x;
  }
  for (const double x : {-39.0, -8.0, 8.0, 39.0}) {
    EXPECT_GE(of(x).share, 0.0);
    EXPECT_LE(of(x).share, 1.0);
    EXPECT_TRUE(std::isfinite(of(x).log_slope));
  }
}

TEST_P(BothShapes, TheDensityOfXIsThatOfTheShare) {
  // The integral of dt/dx over all x is the length of the bounds.
  const auto slope = [](double x) { return bounded(x, GetParam()).slope; };
  EXPECT_NEAR((boost::math::quadrature::gauss_kronrod<double, 61>::integrate(slope, -38.0, 38.0, 12, 1e-12)), 1.0,
              1e-9);
}

TEST(Bounded, SharpEndsLeaveALineBetweenThem) {
  for (const double share : {0.2, 0.4, 0.5, 0.7}) {
    EXPECT_NEAR(bounded(4.0 * (share - 0.5), BoundShape::sharp).share, share, 1e-3);
    EXPECT_NEAR(bounded(4.0 * (share - 0.5), BoundShape::sharp).pull, 0.0, 0.1);
  }
}

}  // namespace
}  // namespace myoid::inline ground::math
