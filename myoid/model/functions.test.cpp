#include "myoid/model/functions.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/core/error.h"

namespace myoid::model {
namespace {

TEST(SimmSpline, ReproducesACubicExactlyBecauseItsEndsAreNotNatural) {
  std::vector<double> x{-1.0, 0.2, 0.9, 2.0, 2.5};
  std::vector<double> y;
  for (const double v : x) y.push_back(1.0 + v - 2.0 * v * v + 0.5 * v * v * v);
  const Function f = make_simm_spline(x, y);
  for (const double v : {-0.7, 0.2, 0.5, 1.3, 2.2}) {
    const FunctionValue at = evaluate(f, v);
    EXPECT_NEAR(at.value, 1.0 + v - 2.0 * v * v + 0.5 * v * v * v, 1e-13);
    EXPECT_NEAR(at.first, 1.0 - 4.0 * v + 1.5 * v * v, 1e-12);
    EXPECT_NEAR(at.second, -4.0 + 3.0 * v, 1e-11);
  }
}

TEST(SimmSpline, GoesOnAsALineBeyondItsEnds) {
  const Function f = make_simm_spline({0.0, 1.0, 2.0, 3.0}, {0.0, 1.0, 4.0, 9.0});
  EXPECT_NEAR(evaluate(f, 4.0).value, 9.0 + 6.0, 1e-12);
  EXPECT_NEAR(evaluate(f, 4.0).first, 6.0, 1e-12);
  EXPECT_EQ(evaluate(f, 4.0).second, 0.0);
}

TEST(SimmSpline, TwoPointsMakeALine) {
  EXPECT_NEAR(evaluate(Function(make_simm_spline({0.0, 2.0}, {1.0, 5.0})), 3.0).value, 7.0, 1e-15);
}

TEST(PiecewiseLinear, GoesOnWithItsOuterSlopes) {
  const Function f = PiecewiseLinear{{0.0, 1.0, 3.0}, {0.0, 2.0, 3.0}};
  EXPECT_EQ(evaluate(f, -1.0).value, -2.0);
  EXPECT_EQ(evaluate(f, 2.0).value, 2.5);
  EXPECT_EQ(evaluate(f, 5.0).value, 4.0);
}

TEST(Polynomial, HasTheHighestPowerFirst) {
  const FunctionValue v = evaluate(Function(Polynomial{{2.0, -1.0, 3.0}}, 10.0), 2.0);
  EXPECT_EQ(v.value, 90.0);
  EXPECT_EQ(v.first, 70.0);
  EXPECT_EQ(v.second, 40.0);
}

TEST(SimmSpline, RefusesKnotsThatDoNotIncrease) {
  EXPECT_THROW((void)make_simm_spline({0.0, 0.0}, {1.0, 2.0}), InvalidInput);
}

}  // namespace
}  // namespace myoid::model
