#include "myoid/lab/virtual_person/curve_table.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::lab {
namespace {

muscle::CurvePoint<double> cubic(double x) {
  return {1.0 + x * (2.0 + x * (-3.0 + 0.5 * x)), 2.0 + x * (-6.0 + 1.5 * x)};
}

TEST(CurveTable, IsExactForCubics) {
  const CurveTable table(cubic, -1.0, 2.0, 7);
  for (double x = -1.0; x <= 2.0; x += 0.0137) {
    EXPECT_NEAR(table(x).value, cubic(x).value, 1e-13);
    EXPECT_NEAR(table(x).slope, cubic(x).slope, 1e-12);
  }
}

TEST(CurveTable, GoesOnAsTangents) {
  const CurveTable table(cubic, -1.0, 2.0, 7);
  EXPECT_NEAR(table(-1.5).value, cubic(-1.0).value - 0.5 * cubic(-1.0).slope, 1e-13);
  EXPECT_NEAR(table(3.0).value, cubic(2.0).value + cubic(2.0).slope, 1e-13);
  EXPECT_EQ(table(3.0).slope, cubic(2.0).slope);
}

TEST(CurveTable, ItsErrorFallsWithTheFourthPowerOfTheInterval) {
  const auto bell = [](double x) { return muscle::CurvePoint<double>{std::exp(-x * x), -2.0 * x * std::exp(-x * x)}; };
  const auto error = [&bell](int intervals) {
    const CurveTable table(bell, -2.0, 2.0, intervals);
    double worst = 0.0;
    for (double x = -2.0; x < 2.0; x += 0.001) worst = std::max(worst, std::abs(table(x).value - bell(x).value));
    return worst;
  };
  // h^4 / 384 times a fourth derivative of 12.
  EXPECT_LT(error(40), std::pow(0.1, 4) / 384.0 * 12.0 * 1.01);
  EXPECT_NEAR(error(40) / error(80), 16.0, 2.0);
}

TEST(CurveTable, RefusesWhatHoldsNothing) {
  EXPECT_THROW(CurveTable(cubic, 1.0, 1.0, 3), InvalidInput);
  EXPECT_THROW(CurveTable([](double) { return muscle::CurvePoint<double>{NAN, 0.0}; }, 0.0, 1.0, 2), InvalidInput);
}

}  // namespace
}  // namespace myoid::lab
