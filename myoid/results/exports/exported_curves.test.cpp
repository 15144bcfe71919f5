#include "myoid/results/exports/exported_curves.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/fit/measurement/parameters.h"

namespace myoid::results {
namespace {

double at(const opensim::ProjectCurve& curve, double x) {
  for (std::size_t k = 0; k < curve.x.size(); ++k)
    if (std::abs(curve.x[k] - x) < 1e-9) return curve.y[k];
  return std::nan("");
}

TEST(ExportedCurves, HaveTheLawsOfAMuscleOfUnitForceAndLength) {
  fit::MuscleValues unit{};
  unit[fit::kMaxForce] = unit[fit::kFiberLength] = 1.0;
  unit[fit::kWidth] = 0.45;
  unit[fit::kCurvature] = 0.25;
  unit[fit::kProduct] = 0.04;
  unit[fit::kPlateau] = 1.4;
  unit[fit::kSpeed] = 10.0;
  unit[fit::kPassiveForce] = 0.8;
  unit[fit::kPassiveStrain] = 0.6;
  unit[fit::kPassiveShape] = 4.0;
  unit[fit::kTendonStrain] = 0.05;
  const auto curves = exported_curves(unit, 1.0, true);
  ASSERT_EQ(curves.size(), 4U);
  EXPECT_NEAR(at(curves[0], 1.0), 1.0, 1e-12);
  EXPECT_NEAR(at(curves[0], 1.2), std::exp(-std::pow(0.2 / 0.45, 2)), 1e-12);
  EXPECT_EQ(at(curves[1], 1.0), 0.0);
  EXPECT_NEAR(at(curves[1], 1.6), 0.8, 1e-12);
  EXPECT_NEAR(at(curves[3], 0.05), 1.0, 1e-12);
  EXPECT_EQ(exported_curves(unit, 1.0, false).size(), 3U);
}

}  // namespace
}  // namespace myoid::results
