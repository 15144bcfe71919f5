#include "myoid/fit/posterior/marginals.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/math/statistics.h"

namespace myoid::fit {
namespace {

Mode mode_of(const Eigen::VectorXd& x, double log_density, const Eigen::MatrixXd& covariance) {
  Mode mode;
  mode.x = x;
  mode.log_density = log_density;
  mode.covariance = covariance;
  return mode;
}

TEST(Marginal, OfNormalSidesIsTheNormalDistribution) {
  const Marginal normal({-2.0, 2.0}, {-2.0, -2.0});
  for (const double t : {-1.96, -1.0, 0.0, 0.5, 1.96}) {
    EXPECT_NEAR(normal.log_density(t), -0.5 * t * t, 1e-12);
    EXPECT_NEAR(normal.at(t), t, 0.02);
  }
}

TEST(Marginal, HasTheQuantilesOfTheLogarithmOfAGammaVariable) {
  // x = ln(g / a), g of shape a: ln p = a (x - e^x), mode 0, Laplace's sd 1 / sqrt(a).
  for (const double a : {3.0, 8.0}) {
    const double sd = 1.0 / std::sqrt(a);
    const auto side = [&](double t) -> Marginal::Side {
      return {a * (sd * t - std::exp(sd * t) + 1.0), a * sd * (1.0 - std::exp(sd * t))};
    };
    const Marginal marginal(side(-2.0), side(2.0));
    // P(g < a e^x), the integral of the density by steps of 1e-4.
    double sum = 0.0, before = 0.0;
    std::vector<double> wanted{0.025, 0.5, 0.975}, found;
    const double all = std::tgamma(a);
    for (double g = 0.5e-4; found.size() < wanted.size(); g += 1e-4) {
      sum += 1e-4 * std::pow(g, a - 1.0) * std::exp(-g) / all;
      if (before < wanted[found.size()] && sum >= wanted[found.size()]) found.push_back(std::log(g / a) / sd);
      before = sum;
    }
    for (std::size_t i = 0; i < wanted.size(); ++i)
      EXPECT_NEAR(marginal.at(math::normal_quantile(wanted[i])), found[i], 0.06) << a << ' ' << i;
  }
}

TEST(Marginals, FollowTheRidgeOfABanana) {
  // ln p = -x^2 / 2 - (y - x^2 / 4)^2 / (2 0.2^2): x is normal, although the ridge bends away.
  const LogDensity banana = [](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {
    const double off = (at[1] - 0.25 * at[0] * at[0]) / 0.04;
    gradient.resize(2);
    gradient << -at[0] + off * 0.5 * at[0], -off;
    return -0.5 * at[0] * at[0] - 0.5 * 0.04 * off * off;
  };
  const Mode mode = mode_of(Eigen::Vector2d::Zero(), 0.0, Eigen::Vector2d(1.0, 0.04).asDiagonal());
  const std::vector<Marginal> found = marginals(banana, mode, mode.x.size(), {});
  ASSERT_EQ(found.size(), 2U);
  for (const double t : {-1.96, -0.7, 1.96}) EXPECT_NEAR(found[0].at(t), t, 0.03);
}

TEST(Marginals, AFunnelHasItsMassWhereItIsWide) {
  // ln p = -x^2 / 2 - y^2 exp(-2 k x) / 2: integrated over y, x is normal about k.
  for (const double k : {-0.8, 0.3}) {
    const LogDensity funnel = [k](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {
      const double narrow = std::exp(-2.0 * k * at[0]), y = at[1];
      gradient.resize(2);
      gradient << -at[0] + k * y * y * narrow, -y * narrow;
      return -0.5 * at[0] * at[0] - 0.5 * y * y * narrow;
    };
    const Mode mode = mode_of(Eigen::Vector2d::Zero(), 0.0, Eigen::Matrix2d::Identity());
    const std::vector<Marginal> found = marginals(funnel, mode, mode.x.size(), {});
    for (const double t : {-1.96, 0.0, 1.96}) EXPECT_NEAR(found[0].at(t), t + k, 0.03) << k;
    EXPECT_NEAR(found[1].at(0.0), 0.0, 0.02);
  }
}

TEST(Marginals, OfANormalDensityDrawTheNormalDistribution) {
  Eigen::Matrix2d covariance;
  covariance << 4.0, 1.2, 1.2, 1.0;
  const Eigen::Vector2d mean(3.0, -2.0);
  const Eigen::Matrix2d precision = covariance.inverse();
  const LogDensity normal = [&](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    gradient = precision * (mean - x);
    return 0.5 * gradient.dot(x - mean);
  };
  const Mode mode = mode_of(mean, 0.0, covariance);
  const Eigen::MatrixXd draws = draw_about(mode, marginals(normal, mode, mode.x.size(), {}), 20000, 7);
  const Eigen::VectorXd average = draws.rowwise().mean();
  const Eigen::MatrixXd off = draws.colwise() - average;
  EXPECT_LT((average - mean).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_LT((off * off.transpose() / static_cast<double>(off.cols()) - covariance).cwiseAbs().maxCoeff(), 0.1);
}

TEST(Marginals, ASideWithoutADensityStaysNormal) {
  const LogDensity half = [](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    gradient = -x;
    return x[0] < -1.0 ? -HUGE_VAL : -0.5 * x.squaredNorm();
  };
  const Mode mode = mode_of(Eigen::VectorXd::Zero(1), 0.0, Eigen::MatrixXd::Identity(1, 1));
  EXPECT_NEAR(marginals(half, mode, mode.x.size(), {}).front().at(-1.96), -1.96, 0.02);
}

}  // namespace
}  // namespace myoid::fit
