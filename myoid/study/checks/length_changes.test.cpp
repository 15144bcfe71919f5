#include "myoid/study/checks/length_changes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::study {
namespace {

/// Three muscles over a joint that swings: l = l0 - r q with constant moment arms.
struct Swing {
  Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(1001, 0.0, 10.0);
  Eigen::VectorXd angle_rad = time_s.array().sin();
  Eigen::RowVector3d arm_m{0.03, -0.02, 0.01};
  Eigen::MatrixXd arms_m = arm_m.replicate(time_s.size(), 1);
  Eigen::MatrixXd lengths_m = -angle_rad * arm_m;
  ChangeWindows windows = change_windows(time_s);
};

TEST(LengthChanges, WindowsShareTheirEnds) {
  const Swing swing;
  EXPECT_EQ(swing.windows.reach, 10);
  EXPECT_EQ(swing.windows.count, 100);
  EXPECT_EQ(swing.windows.first(100), 1000);
  EXPECT_EQ(change_windows(Eigen::VectorXd::Zero(1)).count, 0);
}

TEST(LengthChanges, AreTheIntegralsOfTheRateAndOfTheMomentArms) {
  const Swing swing;
  const Eigen::MatrixXd velocities_mps = -swing.time_s.array().cos().matrix() * swing.arm_m;
  const Eigen::MatrixXd dl = changes(swing.windows, swing.lengths_m);
  // The trapezoidal rule is exact for constant moment arms. Its error of the rate is h^2/12 of the change.
  EXPECT_LT((dl + integrals(swing.windows, swing.arms_m, swing.angle_rad)).norm(), 1e-14 * dl.norm());
  EXPECT_LT((dl - integrals(swing.windows, velocities_mps, swing.time_s)).norm(), 1e-5 * dl.norm());
}

TEST(LengthChanges, FollowFromTheMomentArmsUnlessASignIsWrong) {
  const Swing swing;
  const Eigen::MatrixXd dl = changes(swing.windows, swing.lengths_m);
  Eigen::MatrixXd wrong = swing.arms_m;
  wrong.col(1) *= -1.0;
  EXPECT_NEAR(share_by_arms(swing.windows, dl, {&swing.arms_m}), 1.0, 1e-12);
  // The best dq of arms r for changes along s explains (r.s)^2 / (|r| |s|)^2: (9 - 4 + 1)^2 / 14^2.
  EXPECT_NEAR(share_by_arms(swing.windows, dl, {&wrong}), 36.0 / 196.0, 1e-12);
  EXPECT_NEAR(share_by_arms(swing.windows, dl, {&wrong}, {.turned = 1}), 1.0, 1e-12);
  EXPECT_NEAR(share_by_arms(swing.windows, dl, {&wrong}, {.without = 1}), 1.0, 1e-12);
  EXPECT_EQ(share_by_arms(swing.windows, dl.leftCols(1), {&swing.arms_m}), 0.0);
}

TEST(LengthChanges, OfNoiseAreNoMovement) {
  const Swing swing;
  const Eigen::MatrixXd dl = changes(swing.windows, swing.lengths_m);
  EXPECT_TRUE(is_moved(dl));
  EXPECT_FALSE(is_moved(0.1 * dl));
  EXPECT_FALSE(is_moved(dl.topRows(4)));
}

}  // namespace
}  // namespace myoid::study
