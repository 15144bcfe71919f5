#include "myoid/ground/math/draws.h"

#include <gtest/gtest.h>

namespace myoid::inline ground::math {
namespace {

TEST(Draws, OfTheNormalDistributionHaveItsMeanAndCovariance) {
  const Eigen::Vector2d mean(1.0, -2.0);
  Eigen::Matrix2d covariance;
  covariance << 2.0, 0.6, 0.6, 0.5;
  const Eigen::MatrixXd draws = draw_normal(mean, covariance, 20000, 3);
  const Eigen::Vector2d found = draws.rowwise().mean();
  // Four standard errors of 20,000 draws.
  EXPECT_LT((found - mean).cwiseAbs().maxCoeff(), 4.0 * std::sqrt(2.0 / 20000.0));
  const Eigen::MatrixXd off = draws.colwise() - found;
  const Eigen::Matrix2d spread = off * off.transpose() / static_cast<double>(off.cols());
  EXPECT_LT((spread - covariance).cwiseAbs().maxCoeff(), 4.0 * 2.0 * std::sqrt(2.0 / 20000.0));
}

TEST(Draws, AQuantileLiesWhereTheWeightLies) {
  // Middles of the weights are 0.1, 0.4 and 0.8: 0.25 is half-way between 1 and 3.
  const Eigen::Vector3d values(3.0, 1.0, 10.0), weight(0.4, 0.2, 0.4);
  EXPECT_NEAR(weighted_quantile(values, weight, 0.25), 2.0, 1e-12);
  EXPECT_NEAR(weighted_quantile(values, weight, 0.6), 6.5, 1e-12);
  EXPECT_EQ(weighted_quantile(values, weight, 0.999), 10.0);
}

}  // namespace
}  // namespace myoid::inline ground::math
