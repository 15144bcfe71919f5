#include "myoid/muscle/de_groote.h"

#include <cmath>
#include <utility>

#include <ceres/jet.h>
#include <gtest/gtest.h>

namespace myoid::muscle {
namespace {

TEST(DeGroote, CurvesPassThePointsThatOpenSimTests) {
  // opensim-core, testDeGrooteFregly2016Muscle, with its tolerances.
  EXPECT_EQ(de_groote_tendon(0.0, 0.049).value, 0.0);
  EXPECT_NEAR(de_groote_tendon(0.049, 0.049).value, 1.0, 1e-14);
  EXPECT_NEAR(DeGrootePassive<double>(0.6, 4.0)(1.0).value, 0.0182288, 1e-7);
  EXPECT_NEAR(DeGrootePassive<double>(0.6, 4.0)(0.2).value, 0.0, 1e-16);
  EXPECT_NEAR(DeGrootePassive<double>(0.6, 4.0)(1.6).value, 1.0, 1e-15);
  EXPECT_NEAR(de_groote_force_length(1.0).value, 1.0, 1e-14);
  EXPECT_NEAR(de_groote_force_velocity(-1.0).value, 0.0, 1e-14);
  EXPECT_NEAR(de_groote_force_velocity(0.0).value, 1.0, 1e-14);
  EXPECT_NEAR(de_groote_force_velocity(1.0).value, 1.794, 1e-3);
}

TEST(DeGroote, CurvesAreWithinTheRoundingOfThePublishedConstants) {
  // Values of the curves with the supplement's three-digit constants, from another implementation
  // (pariterre/musculotendon_ocp, its tests). b11 differs by 6e-4, d by 1 % and 0.4 %.
  for (const auto& [l, f] :
       {std::pair(0.5, 0.05419527682606315), std::pair(1.0, 0.9994334614323869), std::pair(1.5, 0.22611061742850164)}) {
    EXPECT_NEAR(de_groote_force_length(l).value, f, 1e-3) << l;
  }
  for (const auto& [v, f] : {std::pair(-2.0, -0.21490297384011525), std::pair(-1.0, 0.012081678112282557),
                             std::pair(-0.5, 0.2438336294197121), std::pair(0.0, 1.002320622548512),
                             std::pair(0.5, 1.5850003902837804), std::pair(1.0, 1.7889099602998804)}) {
    EXPECT_NEAR(de_groote_force_velocity(v).value, f, 0.016) << v;
  }
}

TEST(DeGroote, InverseOfTheVelocityLawInverts) {
  for (double v = -2.0; v < 2.0; v += 0.17) {
    EXPECT_NEAR(solve_de_groote_velocity(1.0, 0.0, de_groote_force_velocity(v).value), v, 1e-13);
  }
}

TEST(DeGroote, SolvesTheDampedBalance) {
  for (const double strength : {1e-4, 0.3, 1.2}) {
    for (const double damping : {1e-3, 0.1, 1.0}) {
      for (double v = -5.0; v < 8.0; v += 0.31) {
        const double force = strength * de_groote_force_velocity(v).value + damping * v;
        EXPECT_NEAR(solve_de_groote_velocity(strength, damping, force), v, 1e-11 * (1 + std::abs(v)))
            << strength << ' ' << damping;
      }
    }
  }
}

TEST(DeGroote, SlopesAndEnergiesBelongToTheValues) {
  using Jet = ceres::Jet<double, 1>;
  for (const double x : {0.5, 0.9, 1.0, 1.3}) {
    EXPECT_NEAR(de_groote_force_length(Jet(x, 0)).value.v[0], de_groote_force_length(x).slope, 1e-13);
    EXPECT_NEAR(DeGrootePassive<Jet>(Jet(0.6), Jet(4.0))(Jet(x, 0)).value.v[0],
                DeGrootePassive<double>(0.6, 4.0)(x).slope, 1e-13);
    EXPECT_NEAR(DeGrootePassive<Jet>(Jet(0.6), Jet(4.0)).energy(Jet(x, 0)).v[0],
                DeGrootePassive<double>(0.6, 4.0)(x).value, 1e-14);
  }
  for (const double v : {-1.2, -0.1, 0.0, 0.6}) {
    EXPECT_NEAR(de_groote_force_velocity(Jet(v, 0)).value.v[0], de_groote_force_velocity(v).slope, 1e-12);
  }
  for (const double e : {-0.01, 0.01, 0.06}) {
    EXPECT_NEAR(de_groote_tendon(Jet(e, 0), Jet(0.049)).value.v[0], de_groote_tendon(e, 0.049).slope, 1e-11);
    EXPECT_NEAR(de_groote_tendon_energy(Jet(e, 0), Jet(0.049)).v[0], de_groote_tendon(e, 0.049).value, 1e-14);
  }
  EXPECT_NEAR(DeGrootePassive<double>(0.6, 4.0).energy(0.2), 0.0, 1e-17);
}

}  // namespace
}  // namespace myoid::muscle
