#include "myoid/identification/resting_torque.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace myoid::identification {
namespace {

/// A joint moved from `low` to `high` and back, n samples.
struct Moved {
  Moved(double low, double high, Eigen::Index n) : angle_rad(n), velocity_radps(n) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const double phase = 2.0 * M_PI * static_cast<double>(i) / static_cast<double>(n - 1);
      angle_rad[i] = 0.5 * (low + high) - 0.5 * (high - low) * std::cos(phase);
      velocity_radps[i] = 0.5 * (high - low) * std::sin(phase);
    }
  }
  Eigen::VectorXd angle_rad, velocity_radps;
};

TEST(RestingTorque, APolynomialOfTheFifthDegreeAndADashpotComeBack) {
  const Moved moved(0.2, 2.2, 401);
  const auto elastic = [](double q) {
    return 4.0 - 3.0 * q + 0.8 * q * q - 1.1 * std::pow(q, 3) + 0.4 * std::pow(q, 4) -
           0.07 * std::pow(q, 5);
  };
  const Eigen::VectorXd torque = moved.angle_rad.unaryExpr(elastic) - 0.25 * moved.velocity_radps;
  const auto found = fit_resting_torque(moved.angle_rad, moved.velocity_radps, torque);
  ASSERT_TRUE(found);
  for (const double q : {0.2, 0.7, 1.3, 2.2}) EXPECT_NEAR(found->at(q), elastic(q), 1e-10);
  EXPECT_NEAR(found->viscosity_nms, 0.25, 1e-10);
  EXPECT_NEAR(found->residual_nm, 0.0, 1e-10);
}

TEST(RestingTorque, AnExponentialThatRisesTwentyfoldIsMetToAThousandth) {
  const Moved moved(0.0, 2.0, 401);
  const auto elastic = [](double q) { return -6.0 * std::exp(0.5 * std::log(20.0) * (q - 2.0)); };
  const auto found =
      fit_resting_torque(moved.angle_rad, moved.velocity_radps, moved.angle_rad.unaryExpr(elastic));
  ASSERT_TRUE(found);
  for (double q = 0.0; q <= 2.0; q += 0.05) EXPECT_NEAR(found->at(q), elastic(q), 6e-3);
}

TEST(RestingTorque, BeyondTheMeasuredAnglesTheValueAtTheirEndStays) {
  const Moved moved(0.5, 1.5, 201);
  const auto found =
      fit_resting_torque(moved.angle_rad, moved.velocity_radps, -2.0 * moved.angle_rad);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->at(0.1), -1.0, 1e-10);
  EXPECT_NEAR(found->at(3.0), -3.0, 1e-10);
}

TEST(RestingTorque, OverASmallRangeNoShapeIsSought) {
  const Moved moved(1.0, 1.2, 200);  // 11 degrees
  const auto found = fit_resting_torque(moved.angle_rad, moved.velocity_radps,
                                        -2.0 * (moved.angle_rad.array() - 1.1).matrix());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->coefficient_nm.size(), 1);
  EXPECT_NEAR(found->at(1.2), 0.0, 1e-3);
}

TEST(RestingTorque, AJointMovedOneWayHasItsDashpotInTheElasticPart) {
  const Eigen::VectorXd angle = Eigen::VectorXd::LinSpaced(100, 0.0, 1.0);
  const Eigen::VectorXd velocity = Eigen::VectorXd::Constant(100, 0.5);
  const auto found = fit_resting_torque(angle, velocity, -0.2 * velocity);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->viscosity_nms, 0.0);
  EXPECT_NEAR(found->at(0.5), -0.1, 1e-12);
}

TEST(RestingTorque, TooFewSamplesOrANaNTellNothing) {
  const Moved moved(0.0, 2.0, 19);
  EXPECT_FALSE(fit_resting_torque(moved.angle_rad, moved.velocity_radps, moved.angle_rad));
  const Moved enough(0.0, 2.0, 40);
  Eigen::VectorXd torque = enough.angle_rad;
  torque[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(fit_resting_torque(enough.angle_rad, enough.velocity_radps, torque));
}

TEST(RestingTorque, AJointThatHardlyMovesHasNoDashpotToBeSeen) {
  const Moved moved(0.0, 2.0, 401);
  const Eigen::VectorXd creeping = 0.04 * moved.velocity_radps;
  const auto found = fit_resting_torque(moved.angle_rad, creeping, -0.25 * creeping);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->viscosity_nms, 0.0);
}

TEST(RestingTorque, TheResidualIsTheRootMeanSquareOfWhatIsLeft) {
  const Moved moved(0.0, 2.0, 4000);
  Eigen::VectorXd torque = -2.0 * moved.angle_rad;
  for (Eigen::Index i = 0; i < torque.size(); ++i) torque[i] += i % 2 == 0 ? 0.3 : -0.3;
  const auto found = fit_resting_torque(moved.angle_rad, moved.velocity_radps, torque);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->residual_nm, 0.3, 1e-3);
  Eigen::VectorXd velocity = moved.velocity_radps;
  velocity[9] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(fit_resting_torque(moved.angle_rad, velocity, torque));
}

}  // namespace
}  // namespace myoid::identification
