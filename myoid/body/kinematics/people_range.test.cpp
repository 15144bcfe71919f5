#include "myoid/body/kinematics/people_range.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

void expect_range(const char* name, double model_low_deg, double model_high_deg, double low_deg, double high_deg) {
  const auto range = people_range(name, model_low_deg * kDegree, model_high_deg * kDegree);
  ASSERT_TRUE(range) << name;
  EXPECT_NEAR(range->low_rad / kDegree, low_deg, 1e-9) << name;  // round-off
  EXPECT_NEAR(range->high_rad / kDegree, high_deg, 1e-9) << name;
}

// 20 deg of dorsiflexion and 50 of plantar flexion, 150 deg of the elbow and 135 of the knee (AAOS 1965), 10 more each.
TEST(PeopleRange, IsThePublishedOneOfTheJointThatTheNameMeans) {
  expect_range("ankle_angle_r", -90, 90, -60, 30);
  expect_range("Elbow_Flexion", 0, 130, -10, 160);
  EXPECT_FALSE(people_range("knee_adduction_r", -1.0, 1.0));
  EXPECT_FALSE(people_range("pelvis_tilt", -1.0, 1.0));
}

TEST(PeopleRange, OfAKneeFollowsTheDirectionInWhichTheModelFlexesIt) {
  expect_range("knee_angle_r", -160, 20, -145, 10);
  expect_range("knee_angle_r", -20, 160, -10, 145);
}

}  // namespace
}  // namespace myoid::body
