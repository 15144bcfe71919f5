#include "myoid/fit/intervals/score.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"

namespace myoid::fit {
namespace {

TEST(Score, OfAKnownErrorIsWhatTheDefinitionsSay) {
  const Eigen::Vector4d measured(0.0, 1.0, 2.0, 3.0);
  const Score offset = score(measured, measured.array() + 0.5);
  EXPECT_DOUBLE_EQ(offset.rmse_nm(), 0.5);
  EXPECT_DOUBLE_EQ(offset.nrmse_range(), 0.5 / 3.0);
  EXPECT_DOUBLE_EQ(offset.r2(), 1.0 - 4.0 * 0.25 / 5.0);  // SST = 5
  EXPECT_DOUBLE_EQ(offset.vaf(), 1.0);                    // an offset has no variance
  EXPECT_DOUBLE_EQ(score(measured, Eigen::Vector4d::Constant(1.5)).r2(), 0.0);
}

TEST(Score, OfATorqueThatIsConstantButForRoundingHasNoR2) {
  const Eigen::VectorXd held =
      Eigen::VectorXd::Constant(1001, -1.57) + 1e-16 * Eigen::VectorXd::LinSpaced(1001, -3.0, 3.0);
  EXPECT_EQ(score(held, held.array() + 0.7).r2(), 0.0);
  EXPECT_LT(score(held + 1e-3 * Eigen::VectorXd::LinSpaced(1001, -1.0, 1.0), held.array() + 0.7).r2(), -1e5);
}

TEST(R2Text, IsShortHoweverFarBelowZero) {
  EXPECT_EQ(r2_text(0.9312), "0.931");
  EXPECT_EQ(r2_text(-98.9), "-98.900");
  EXPECT_EQ(r2_text(-150.478), "-150");
  EXPECT_EQ(r2_text(-123456.0), "-1.2e+05");
}

TEST(Below, KeepsWhatIsSlowAndTakesOutWhatIsFast) {
  // Two passes: |H|^2 = 1 / (1 + (f/fd)^4) with fd = 1.5 Hz / 0.8022; 0.25 Hz keeps 0.9998, 6 Hz
  // 0.011.
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(2001, 0.0, 20.0);
  const Eigen::VectorXd slow = (2.0 * kPi * 0.25 * t.array()).sin();
  const Eigen::VectorXd fast = (2.0 * kPi * 6.0 * t.array()).sin();
  const Eigen::VectorXd out = below(t, slow + fast, 1.5);
  EXPECT_LT((out - slow).segment(300, 1400).cwiseAbs().maxCoeff(), 0.015);
  EXPECT_EQ((below(t, fast, 0.0) - fast).norm(), 0.0);
}

TEST(Below, OnAClockThatCannotHoldTheCutOffLeavesTheTorqueAsItIs) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(21, 0.0, 10.0);
  const Eigen::VectorXd x = t.array().sin();
  EXPECT_EQ((below(t, x, 1.5) - x).norm(), 0.0);
}

}  // namespace
}  // namespace myoid::fit
