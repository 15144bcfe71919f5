#include "myoid/body/model/functions.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::body {
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

// The natural spline is the smoothest: of all curves through the points it has the least integral of its squared fourth
// derivative, so that it is orthogonal, in that sense, to every curve through zeros at the knots.
TEST(SepticSpline, PassesItsPointsAndIsTheSmoothest) {
  const std::vector<double> x{-1.0, -0.4, 0.1, 0.9, 1.3, 2.0}, y{0.3, -0.2, 0.5, 0.4, -0.6, 0.1};
  const PiecewisePolynomial s = make_septic_spline(x, y);
  const Function f = s;
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(evaluate(f, x[i]).value, y[i], 1e-12);
  // (x - x1)...(x - x6) vanishes at the knots; its fourth derivative by differences of step 0.01 is
  // exact for degree 6 but for round-off.
  const auto zeros = [&](double v) {
    double product = 1.0;
    for (const double knot : x) product *= v - knot;
    return product;
  };
  double inner = 0.0, size = 0.0;
  constexpr int kSteps = 30000;
  for (int i = 0; i < kSteps; ++i) {
    const double step = 3.0 / kSteps, v = -1.0 + (i + 0.5) * step;
    const auto column = static_cast<Eigen::Index>(std::upper_bound(x.begin(), x.end(), v) - x.begin());
    const double u = v - x[static_cast<std::size_t>(column - 1)];
    double fourth = 0.0;
    for (Eigen::Index k = 7; k >= 4; --k)
      fourth = fourth * u + static_cast<double>(k * (k - 1) * (k - 2) * (k - 3)) * s.coefficients(k, column);
    const double d = 0.1;
    const double bend =
        (zeros(v - 2.0 * d) - 4.0 * zeros(v - d) + 6.0 * zeros(v) - 4.0 * zeros(v + d) + zeros(v + 2.0 * d)) /
            std::pow(d, 4.0) -
        // Fourth differences see the sixth derivative, 720, by d^2/6.
        720.0 * d * d / 6.0;
    inner += fourth * bend * step;
    size += std::abs(fourth * bend) * step;
  }
  EXPECT_LT(std::abs(inner), 1e-6 * size);
  // Beyond the ends a cubic; value and derivatives go on.
  for (const double end : {-1.0, 2.0}) {
    const FunctionValue left = evaluate(f, end - 1e-9), right = evaluate(f, end + 1e-9);
    EXPECT_NEAR(left.value, right.value, 1e-7);
    EXPECT_NEAR(left.first, right.first, 1e-6);
    EXPECT_NEAR(left.second, right.second, 1e-5);
  }
  const auto third = [&](double v) { return (evaluate(f, v + 0.1).second - evaluate(f, v).second); };
  EXPECT_NEAR(third(2.2), third(2.7), 1e-9);
}

TEST(SepticSpline, ReproducesACubic) {
  const std::vector<double> x{0.0, 0.5, 0.7, 2.0, 3.0};
  std::vector<double> y;
  for (const double v : x) y.push_back(1.0 - v + 2.0 * v * v - 0.3 * v * v * v);
  const Function f = make_septic_spline(x, y);
  for (const double v : {-1.0, 0.2, 1.1, 2.5, 4.0}) {
    EXPECT_NEAR(evaluate(f, v).value, 1.0 - v + 2.0 * v * v - 0.3 * v * v * v, 1e-10);
    EXPECT_NEAR(evaluate(f, v).second, 4.0 - 1.8 * v, 1e-9);
  }
  EXPECT_THROW((void)make_septic_spline({0.0, 1.0, 2.0}, {0.0, 1.0, 0.0}), InvalidInput);
}

TEST(SimmSpline, RefusesKnotsThatDoNotIncrease) {
  EXPECT_THROW((void)make_simm_spline({0.0, 0.0}, {1.0, 2.0}), InvalidInput);
}

}  // namespace
}  // namespace myoid::body
