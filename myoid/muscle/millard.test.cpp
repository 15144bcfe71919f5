#include "myoid/muscle/millard.h"

#include <utility>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::muscle {
namespace {

// Points of the default curves, four decimals, as CEINMS 2 tabulates them (RealTimeBiomechanics/
// ceinms2, curves of its test of Lloyd's muscle). Tolerance: their rounding.
constexpr double kRounding = 0.7e-4;

TEST(MillardCurves, ActiveForceLengthPassesTabulatedPoints) {
  const MillardCurves curves;
  for (const auto& [l, f] :
       {std::pair(0.4241, 0.0), std::pair(0.4641, 0.0036), std::pair(0.5441, 0.2531), std::pair(0.6241, 0.5362),
        std::pair(0.7041, 0.7739), std::pair(0.7441, 0.8204), std::pair(0.8641, 0.9260), std::pair(0.9441, 0.9919),
        std::pair(0.9841, 1.0), std::pair(1.0641, 0.9907), std::pair(1.1041, 0.9524), std::pair(1.2241, 0.7902),
        std::pair(1.7841, 0.0117), std::pair(1.8241, 0.0)}) {
    EXPECT_NEAR(curves.force_length(l).value, f, kRounding) << l;
  }
}

TEST(MillardCurves, ForceVelocityPassesTabulatedPoints) {
  const MillardCurves curves;
  for (const auto& [v, f] :
       {std::pair(-1.0, 0.0), std::pair(-0.624, 0.0939), std::pair(-0.312, 0.3174), std::pair(-0.104, 0.6162),
        std::pair(0.0, 1.0), std::pair(0.104, 1.2278), std::pair(0.312, 1.2972), std::pair(0.624, 1.3507),
        std::pair(0.832, 1.3823), std::pair(0.988, 1.4)}) {
    EXPECT_NEAR(curves.force_velocity(v).value, f, kRounding) << v;
  }
}

TEST(MillardCurves, PassiveAndTendonForcePassTabulatedPoints) {
  const MillardCurves curves;
  for (const auto& [l, f] :
       {std::pair(1.0, 0.0), std::pair(1.116, 0.0208), std::pair(1.22, 0.0604), std::pair(1.324, 0.1536),
        std::pair(1.428, 0.3117), std::pair(1.61, 0.7448), std::pair(2.0, 1.8571)}) {
    EXPECT_NEAR(curves.passive(l).value, f, kRounding) << l;
  }
  for (const auto& [strain, f] :
       {std::pair(0.0, 0.0), std::pair(0.02, 0.2609), std::pair(0.06, 1.3087), std::pair(0.1, 2.4311)}) {
    EXPECT_NEAR(curves.tendon(strain / 0.049).value, f, kRounding) << strain;
  }
}

TEST(MillardCurves, HaveTheirDefiningPointsAndSlopes) {
  const MillardCurves curves;
  EXPECT_NEAR(curves.force_length(1.0).value, 1.0, 1e-15);
  EXPECT_NEAR(curves.force_length(1.0).slope, 0.0, 1e-14);
  EXPECT_NEAR(curves.force_velocity(0.0).slope, 5.0, 1e-13);
  EXPECT_NEAR(curves.force_velocity(1.0).value, 1.4, 1e-15);
  EXPECT_NEAR(curves.passive(1.7).value, 1.0, 1e-15);
  EXPECT_NEAR(curves.passive(1.7).slope, 2.0 / 0.7, 1e-13);
  EXPECT_NEAR(curves.tendon(1.0).value, 1.0, 1e-15);
  EXPECT_NEAR(curves.tendon(1.0).slope, 1.375, 1e-13);
  EXPECT_EQ(curves.tendon(-0.3).value, 0.0);
}

TEST(MillardCurves, RefuseShapesThatMakeNoCurve) {
  EXPECT_THROW(MillardCurves({.active = {.transition_length = 0.4}}), InvalidInput);
  EXPECT_THROW(MillardCurves({.passive = {.stiffness_at_one = 1.0}}), InvalidInput);
  EXPECT_THROW(MillardCurves({.velocity = {.concentric_curviness = 1.5}}), InvalidInput);
  EXPECT_THROW(MillardCurves({.velocity = {.max_eccentric_multiplier = 0.9}}), InvalidInput);
}

}  // namespace
}  // namespace myoid::muscle
