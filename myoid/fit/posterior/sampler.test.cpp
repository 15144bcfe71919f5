#include "myoid/fit/posterior/sampler.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/math/draws.h"

namespace myoid::fit {
namespace {

/// Logarithms of independent gamma variables of shape 4: mean digamma(4) = 1.25612, variance
/// trigamma(4) = 0.28382; the gamma variable's median is 3.67206 and its 2.5 % quantile 1.08987.
double skewed(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
  gradient = 4.0 - x.array().exp();
  return (4.0 * x.array() - x.array().exp()).sum();
}

Mode mode_of_skewed(Eigen::Index d) {
  Mode mode;
  mode.x = Eigen::VectorXd::Constant(d, std::log(4.0));
  Eigen::VectorXd gradient;
  mode.log_density = skewed(mode.x, gradient);
  mode.covariance = Eigen::MatrixXd::Identity(d, d) / 4.0;
  return mode;
}

TEST(Sampler, MeanSpreadAndQuantilesOfASkewedDensity) {
  const Sampled sampled = sample_density(skewed, mode_of_skewed(20), 1000, 3, {});
  EXPECT_TRUE(sampled.trusted());
  EXPECT_EQ(sampled.draws.cols(), 1000);
  // All 20 entries together: 20,000 draws, of which a third may be independent.
  const Eigen::VectorXd x = sampled.draws.reshaped();
  const Eigen::VectorXd weight = Eigen::VectorXd::Constant(x.size(), 1.0 / static_cast<double>(x.size()));
  EXPECT_NEAR(x.mean(), 1.25612, 0.03);
  EXPECT_NEAR((x.array() - x.mean()).square().mean(), 0.28382, 0.03);
  EXPECT_NEAR(math::weighted_quantile(x, weight, 0.5), std::log(3.67206), 0.03);
  EXPECT_NEAR(math::weighted_quantile(x, weight, 0.025), std::log(1.08987), 0.08);
}

TEST(Sampler, ACorrelatedNormalInTheWrongCoordinatesIsStillItself) {
  // The covariance it is given is the identity; the truth has a correlation of 0.9.
  Eigen::Matrix2d truth;
  truth << 1.0, 0.9, 0.9, 1.0;
  const Eigen::Matrix2d precision = truth.inverse();
  const auto density = [&](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    gradient = -precision * x;
    return 0.5 * x.dot(gradient);
  };
  Mode mode;
  mode.x = Eigen::Vector2d::Zero();
  mode.covariance = Eigen::Matrix2d::Identity();
  const Sampled sampled = sample_density(density, mode, 8000, 5, {});
  const Eigen::MatrixXd& x = sampled.draws;
  const Eigen::Matrix2d spread = x * x.transpose() / static_cast<double>(x.cols());
  EXPECT_LT((spread - truth).cwiseAbs().maxCoeff(), 0.1);
}

TEST(Sampler, SaysWhereTheChainsStayApart) {
  // Two modes that are 24 standard deviations apart, and a start between them.
  const auto density = [](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    const double off = std::abs(x[0]) - 12.0;
    gradient = Eigen::VectorXd::Constant(1, x[0] > 0.0 ? -off : off);
    return -0.5 * off * off;
  };
  Mode mode;
  mode.x = Eigen::VectorXd::Zero(1);
  mode.log_density = -72.0;
  mode.covariance = Eigen::MatrixXd::Identity(1, 1);
  EXPECT_FALSE(sample_density(density, mode, 400, 2, {}).trusted());
}

TEST(Sampler, TheSameSeedGivesTheSameDraws) {
  const Mode mode = mode_of_skewed(3);
  const Sampled one = sample_density(skewed, mode, 40, 7, {});
  EXPECT_EQ(one.draws, sample_density(skewed, mode, 40, 7, {}).draws);
  EXPECT_NE(one.draws, sample_density(skewed, mode, 40, 8, {}).draws);
}

}  // namespace
}  // namespace myoid::fit
