#include "myoid/fit/measurement/postures.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::fit {
namespace {

/// A trial of one muscle with the moment arm 0.04 m, length 0.3 m - 0.04 q, at these angles.
TrialData trial_at(const Eigen::VectorXd& angle_rad) {
  TrialData trial;
  trial.joint = "elbow";
  const Eigen::Index n = angle_rad.size();
  trial.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, 1.0);
  trial.angle_rad = angle_rad;
  trial.velocity_radps = Eigen::VectorXd::LinSpaced(n, -2.0, 3.0);
  trial.length_m = 0.3 - 0.04 * angle_rad.array();
  trial.velocity_mps = -0.04 * trial.velocity_radps;
  trial.moment_arm_m = Eigen::MatrixXd::Constant(n, 1, 0.04);
  return trial;
}

TEST(Postures, HaveTheRecordedLengthsOverTheRecordedRange) {
  StudyData data;
  data.muscles.resize(1);
  // Two ranges with a gap from 0.6 to 1.4 rad.
  data.trials = {trial_at(Eigen::VectorXd::LinSpaced(400, 0.2, 0.6)),
                 trial_at(Eigen::VectorXd::LinSpaced(400, 1.4, 2.0))};
  const Postures found = postures(data, "elbow", 0);
  ASSERT_TRUE(found.over_angle);
  ASSERT_GT(found.count(), 20);
  EXPECT_NEAR(found.place[0], 0.2, 1e-9);
  EXPECT_NEAR(found.place[found.count() - 1], 2.0, 1e-9);
  for (Eigen::Index i = 0; i < found.count(); ++i) {
    EXPECT_NEAR(found.length_m(i, 0), 0.3 - 0.04 * found.place[i], 1e-9);
    EXPECT_NEAR(found.arm_m(i, 0), 0.04, 1e-12);
  }
  EXPECT_NEAR(found.scatter_m[0], 0.0, 1e-9);
  EXPECT_NEAR(found.fastest_radps, 3.0, 1e-12);
  EXPECT_NEAR(found.fastest_back_radps, 2.0, 1e-12);
}

TEST(Postures, OtherJointsShowAsScatter) {
  StudyData data;
  data.muscles.resize(1);
  data.trials = {trial_at(Eigen::VectorXd::LinSpaced(1000, 0.2, 2.0))};
  for (Eigen::Index i = 0; i < 1000; ++i) data.trials[0].length_m(i, 0) += i % 2 == 0 ? 0.01 : -0.01;
  EXPECT_NEAR(postures(data, "elbow", 0).scatter_m[0], 0.01, 1e-4);
}

TEST(Postures, WithoutAnglesAreThoseOfTheLength) {
  StudyData data;
  data.muscles.resize(1);
  data.trials = {trial_at(Eigen::VectorXd::LinSpaced(1000, 0.2, 2.0))};
  data.trials[0].angle_rad.resize(0);
  const Postures found = postures(data, "elbow", 0);
  EXPECT_FALSE(found.over_angle);
  EXPECT_NEAR(found.place[0], 0.3 - 0.04 * 2.0, 0.002);
  for (Eigen::Index i = 0; i < found.count(); ++i) EXPECT_NEAR(found.length_m(i, 0), found.place[i], 1e-9);
}

TEST(Postures, OfAJointWithoutMomentArmsAreNone) {
  StudyData data;
  data.muscles.resize(1);
  data.trials = {trial_at(Eigen::VectorXd::LinSpaced(100, 0.2, 2.0))};
  EXPECT_EQ(postures(data, "knee", 0).count(), 0);
}

TEST(Postures, OneAngleIsOnePosture) {
  StudyData data;
  data.muscles.resize(1);
  data.trials = {trial_at(Eigen::VectorXd::Constant(100, 1.5))};
  const Postures found = postures(data, "elbow", 0);
  ASSERT_EQ(found.count(), 1);
  EXPECT_NEAR(found.place[0], 1.5, 1e-12);
}

}  // namespace
}  // namespace myoid::fit
