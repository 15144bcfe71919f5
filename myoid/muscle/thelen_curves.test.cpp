#include "myoid/muscle/thelen_curves.h"

#include <cmath>

#include <ceres/jet.h>
#include <gtest/gtest.h>

namespace myoid::muscle {
namespace {

TEST(ThelenCurves, PassiveForceIsThePublishedExponential) {
  EXPECT_EQ(ThelenPassive<double>(0.6, 5.0)(0.9).value, 0.0);
  EXPECT_EQ(ThelenPassive<double>(0.6, 5.0)(1.0).value, 0.0);
  EXPECT_NEAR(ThelenPassive<double>(0.6, 5.0)(1.6).value, 1.0, 1e-15);
  EXPECT_NEAR(ThelenPassive<double>(0.6, 5.0)(1.3).value, std::expm1(2.5) / std::expm1(5.0), 1e-15);
}

TEST(ThelenCurves, TendonHasThePublishedToeAndLine) {
  // Rounded in the publication to 0.609 e0 and 1.712 / e0.
  EXPECT_NEAR(kThelenToeShare, 0.609, 5e-4);
  const double e0 = 0.04;
  EXPECT_NEAR(thelen_tendon(0.03, e0).slope * e0, 1.712, 3e-3);
  EXPECT_NEAR(thelen_tendon(e0, e0).value, 1.0, 1e-15);
  EXPECT_NEAR(thelen_tendon(kThelenToeShare * e0, e0).value, 0.33, 1e-15);
  EXPECT_NEAR(thelen_tendon(0.5 * kThelenToeShare * e0, e0).value, 0.33 * std::expm1(1.5) / std::expm1(3.0), 1e-15);
  EXPECT_EQ(thelen_tendon(-0.01, e0).value, 0.0);
  // One slope at the end of the toe, by its definition.
  const double toe = kThelenToeShare * e0;
  EXPECT_NEAR(thelen_tendon(toe * (1 - 1e-12), e0).slope, thelen_tendon(toe * (1 + 1e-12), e0).slope, 1e-8);
}

TEST(ThelenCurves, VelocityLawInvertsThePublishedOne) {
  // v = (1/4 + 3/4 a) (F - a f_l) / b, b = a f_l + F / A_f below, (2 + 2 / A_f)(a f_l F_len - F) /
  // (F_len - 1) above; F in units of a f_l here.
  const double af = 0.3, flen = 1.8;
  const auto hyperbola = thelen_hyperbola(af, flen);
  for (const double a : {0.05, 0.5, 1.0}) {
    for (const double f : {0.1, 0.5, 0.99, 1.01, 1.3, 1.7}) {
      const double b = f <= 1.0 ? 1.0 + f / af : (2.0 + 2.0 / af) * (flen - f) / (flen - 1.0);
      const double v = thelen_speed(a) * (f - 1.0) / b;
      EXPECT_NEAR(force_velocity(hyperbola, v / thelen_speed(a)).value, f, 1e-14);
    }
  }
}

TEST(ThelenCurves, SlopesAndEnergiesBelongToTheValues) {
  using Jet = ceres::Jet<double, 1>;
  for (const double l : {0.8, 1.1, 1.5}) {
    EXPECT_NEAR(ThelenPassive<Jet>(Jet(0.6), Jet(4.0))(Jet(l, 0)).value.v[0], ThelenPassive<double>(0.6, 4.0)(l).slope,
                1e-13);
    EXPECT_NEAR(ThelenPassive<Jet>(Jet(0.6), Jet(4.0)).energy(Jet(l, 0)).v[0], ThelenPassive<double>(0.6, 4.0)(l).value,
                1e-14);
  }
  for (const double e : {-0.01, 0.004, 0.02, 0.035, 0.06}) {
    EXPECT_NEAR(thelen_tendon(Jet(e, 0), Jet(0.04)).value.v[0], thelen_tendon(e, 0.04).slope, 1e-12);
    EXPECT_NEAR(thelen_tendon_energy(Jet(e, 0), Jet(0.04)).v[0], thelen_tendon(e, 0.04).value, 1e-14);
  }
  // Continuous where the toe ends: an energy of 1e-3 and a step of 1e-12 of it.
  const double toe = kThelenToeShare * 0.04;
  EXPECT_NEAR(thelen_tendon_energy(toe * (1 - 1e-12), 0.04), thelen_tendon_energy(toe * (1 + 1e-12), 0.04), 1e-13);
}

}  // namespace
}  // namespace myoid::muscle
