#include "myoid/ground/math/shape_preserving_curve.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {
namespace {

Eigen::VectorXd vector(std::initializer_list<double> values) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), v.data());
  return v;
}

TEST(ShapePreservingCurve, PassesItsSamplesAndHasTheSlopeOfItsValue) {
  const ShapePreservingCurve curve(vector({0.0, 0.1, 0.4, 0.5, 1.0}), vector({1.0, 3.0, 3.5, 2.0, 2.2}), "test");
  EXPECT_EQ(curve.at(0.1).value, 3.0);
  EXPECT_NEAR(curve.at(1.0).value, 2.2, 1e-15);
  const double h = 1e-6;  // truncation h^2 f''' / 6 with f''' below 1e4: 2e-9
  for (double t = 0.013; t < 1.0; t += 0.0171) {
    EXPECT_NEAR(curve.at(t).slope, (curve.at(t + h).value - curve.at(t - h).value) / (2 * h), 1e-7);
  }
}

TEST(ShapePreservingCurve, NeverLeavesTheRangeOfNeighboringSamples) {
  const Eigen::VectorXd t = vector({0.0, 0.1, 0.15, 0.4, 0.41, 1.0});
  const Eigen::VectorXd y = vector({0.0, 0.0, 1.0, 1.0, -2.0, -2.1});
  const ShapePreservingCurve curve(t, y, "test");
  for (Eigen::Index k = 0; k + 1 < t.size(); ++k) {
    for (double share = 0.0; share <= 1.0; share += 0.05) {
      const double value = curve.at(t(k) + share * (t(k + 1) - t(k))).value;
      EXPECT_GE(value, std::min(y(k), y(k + 1)) - 1e-15);
      EXPECT_LE(value, std::max(y(k), y(k + 1)) + 1e-15);
    }
  }
}

TEST(ShapePreservingCurve, IsExactForLinesAndStandsStillOutside) {
  const ShapePreservingCurve line(vector({1.0, 1.3, 2.0}), vector({2.0, 2.6, 4.0}), "test");
  EXPECT_NEAR(line.at(1.77).value, 3.54, 1e-15);
  EXPECT_NEAR(line.at(1.77).slope, 2.0, 1e-14);
  EXPECT_EQ(line.at(0.0).value, 2.0);
  EXPECT_EQ(line.at(0.0).slope, 0.0);
  EXPECT_EQ(line.at(9.0).value, 4.0);
}

TEST(ShapePreservingCurve, SlopesAreThoseOfFritschAndButland) {
  // Interior: 3 (h0 + h1) / ((2 h1 + h0) / s0 + (h1 + 2 h0) / s1) for steps h0, h1 of slopes s0, s1.
  const ShapePreservingCurve curve(vector({0.0, 1.0, 3.0}), vector({0.0, 2.0, 3.0}), "test");
  EXPECT_NEAR(curve.at(1.0).slope, 9.0 / (5.0 / 2.0 + 4.0 / 0.5), 1e-15);
}

TEST(ShapePreservingCurve, RefusesWhatIsNoFunctionOfTime) {
  EXPECT_THROW(ShapePreservingCurve(vector({0.0}), vector({1.0}), "x"), InvalidInput);
  EXPECT_THROW(ShapePreservingCurve(vector({0.0, 0.0}), vector({1.0, 2.0}), "x"), InvalidInput);
  EXPECT_THROW(ShapePreservingCurve(vector({0.0, 1.0}), vector({1.0, std::nan("")}), "x"), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground::math
