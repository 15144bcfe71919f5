#include "myoid/fit/intervals/voluntary_curve.h"

#include <gtest/gtest.h>

namespace myoid::fit {
namespace {

TEST(VoluntaryNames, TellTorqueAngleAndPowerApartWithAnyEnding) {
  EXPECT_TRUE(is_voluntary("voluntary_torque_at_knee_angle"));
  EXPECT_FALSE(is_voluntary("max_isometric_force"));
  EXPECT_TRUE(is_voluntary_angle("voluntary_torque_angle_positive"));
  EXPECT_FALSE(is_voluntary_angle("voluntary_torque_positive"));
  EXPECT_TRUE(is_voluntary_power("voluntary_power_120_negative"));
  EXPECT_FALSE(is_voluntary_power("voluntary_torque"));
}

}  // namespace
}  // namespace myoid::fit
