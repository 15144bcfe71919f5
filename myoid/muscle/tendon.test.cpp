#include "myoid/muscle/tendon.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

namespace myoid::muscle {
namespace {

TEST(Tendon, DoesNotPushWhenSlack) {
  EXPECT_EQ(tendon_force(0.19, 0.2, 1e5), 0.0);
  EXPECT_EQ(tendon_force(0.2, 0.2, 1e5), 0.0);
}

TEST(Tendon, PullsWithItsStiffness) { EXPECT_NEAR(tendon_force(0.203, 0.2, 1e5), 300.0, 1e-9); }

TEST(Tendon, DerivativeIsTheStiffnessAboveSlackAndZeroBelow) {
  using Jet = ceres::Jet<double, 1>;
  EXPECT_EQ(tendon_force(Jet(0.21, 0), Jet(0.2), Jet(1e5)).v[0], 1e5);
  EXPECT_EQ(tendon_force(Jet(0.19, 0), Jet(0.2), Jet(1e5)).v[0], 0.0);
}

TEST(Tendon, StiffnessStretchesByTheGivenStrainUnderMaximalForce) {
  const double k = tendon_stiffness_npm(624.3, 0.2723, 0.033);
  EXPECT_NEAR(tendon_force(0.2723 * 1.033, 0.2723, k), 624.3, 1e-9);
}

}  // namespace
}  // namespace myoid::muscle
