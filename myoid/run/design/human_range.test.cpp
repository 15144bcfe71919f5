#include "myoid/run/design/human_range.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"

namespace myoid::run {
namespace {

void expect_range(const char* name, double model_low_deg, double model_high_deg, double low_deg, double high_deg) {
  const ProposedRange range = human_range(name, model_low_deg * kDegree, model_high_deg * kDegree);
  EXPECT_NEAR(range.low_rad / kDegree, low_deg, 1e-9) << name;  // round-off
  EXPECT_NEAR(range.high_rad / kDegree, high_deg, 1e-9) << name;
  EXPECT_EQ(range.says.empty(), model_low_deg == low_deg && model_high_deg == high_deg) << name;
}

// 20 deg of dorsiflexion and 50 of plantar flexion (AAOS 1965), 10 deg more at either end.
TEST(HumanRange, OfAnAnkleThatTheModelTurnsByNinetyDegreesIsThePublishedOne) {
  expect_range("ankle_angle_r", -90, 90, -60, 30);
  expect_range("ankle_angle_l", -40, 90, -40, 30);
}

TEST(HumanRange, OfAKneeFollowsTheDirectionInWhichTheModelFlexesIt) {
  expect_range("knee_angle_r", -160, 20, -145, 10);
  expect_range("knee_angle_r", -20, 160, -10, 145);
}

TEST(HumanRange, OfAModelWithinItIsTheModels) {
  expect_range("elbow_flexion", -10, 150, -10, 150);
  expect_range("knee_angle_r", -120, 10, -120, 10);
  expect_range("knee_adduction_r", -90, 90, -90, 90);
  expect_range("pelvis_tilt", -90, 90, -90, 90);
  expect_range("ankle_angle_r", 60, 120, 60, 120);  // another zero
}

}  // namespace
}  // namespace myoid::run
