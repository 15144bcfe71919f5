#include "myoid/study/checks/muscle_pulls.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

using namespace test_trials;

TEST(MusclePulls, AChannelOfTheArmPullsAsItsMuscleDoes) {
  const Pulls pulls = pulls_on(arm_study(), arm(), "elbow_flexion");
  ASSERT_EQ(pulls.channels.size(), 4U);
  EXPECT_GT(pulls.strength_nm.head(3).minCoeff(), 0.0);
  EXPECT_LT(pulls.strength_nm[3], 0.0);
  EXPECT_DOUBLE_EQ(pulls.together().positive_nm, pulls.strength_nm.head(3).sum());
}

/// Two channels of opposite muscles over one sample.
Sums sums_of(double flexor, double extensor, double torque_nm) {
  const Eigen::Vector2d emg(flexor, extensor);
  return {emg * emg.transpose(), -torque_nm * emg, torque_nm * torque_nm};
}

TEST(MusclePulls, ATorqueIsComparedWithTheOneThatTheMusclesLeave) {
  const Eigen::Vector2d strength_nm(60.0, -40.0);
  const Sums push = sums_of(0.5, 0.25, -20.0);  // 30 N m against 10 N m
  EXPECT_NEAR(push.torque_over_pull(strength_nm), 1.0, 1e-12);
  EXPECT_NEAR(push.unopposed(strength_nm), 0.5, 1e-12);
  EXPECT_NEAR(push.cosine(strength_nm), 1.0, 1e-12);
  EXPECT_NEAR(sums_of(0.5, 0.25, 20.0).cosine(strength_nm), -1.0, 1e-12);
  EXPECT_NEAR(sums_of(0.4, 0.6, -1.0).unopposed(strength_nm), 0.0, 1e-7);  // the root of rounding
}

}  // namespace
}  // namespace myoid::study
