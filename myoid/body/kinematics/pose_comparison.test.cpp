#include "myoid/body/kinematics/pose_comparison.h"

#include <gtest/gtest.h>

namespace myoid::body {
namespace {

PoseFit::Pose pose(double angle, double cost, bool converged = true) {
  return {Eigen::VectorXd::Constant(1, angle), cost, converged};
}

TEST(PoseComparison, AGainIsADifferenceOverTheLowerCost) {
  EXPECT_NEAR(gain_of(pose(0.0, 1.0), pose(1.0, 3.0)), 2.0, 1e-9);
  EXPECT_NEAR(gain_of(pose(0.0, 3.0), pose(1.0, 1.0)), -2.0, 1e-9);
  EXPECT_TRUE(clearly_better(pose(0.0, 1e-4), pose(1.0, 1.02e-4)));
  EXPECT_FALSE(clearly_better(pose(0.0, 1e-4), pose(1.0, 1.005e-4)));
}

TEST(PoseComparison, OnlyAConvergedPoseReplacesAConvergedOne) {
  EXPECT_TRUE(replaces(pose(0.0, 1.0), pose(0.0, 3.0), 0.5));
  EXPECT_FALSE(replaces(pose(0.0, 2.0), pose(0.0, 3.0), 0.5));
  EXPECT_FALSE(replaces(pose(0.0, 1.0, false), pose(0.0, 3.0), 0.5));
  EXPECT_TRUE(replaces(pose(0.0, 3.0), pose(0.0, 3.0, false), 0.5));
}

TEST(PoseComparison, OneMinimumHasOnePostureAndOneCost) {
  EXPECT_TRUE(same_posture(pose(0.2, 1.0), pose(0.2 + 1e-6, 1.0)));
  EXPECT_FALSE(same_posture(pose(0.2, 1.0), pose(0.3, 1.0)));
}

}  // namespace
}  // namespace myoid::body
