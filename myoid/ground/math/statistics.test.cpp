#include "myoid/ground/math/statistics.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::inline ground::math {
namespace {

Eigen::VectorXd autoregressive(Eigen::Index n, double rho) {
  std::mt19937_64 engine(9);
  Eigen::VectorXd x(n);
  double last = 0.0;
  for (double& v : x) {
    double noise = -6.0;
    for (int k = 0; k < 12; ++k) noise += static_cast<double>(engine() >> 11) * 0x1.0p-53;
    v = last = rho * last + noise;
  }
  return x;
}

TEST(Median, IsTheMiddleOrTheMeanOfTheTwoInTheMiddle) {
  EXPECT_EQ(median({5.0, 1.0, 3.0}), 3.0);
  EXPECT_EQ(median({4.0, 1.0, 3.0, 100.0}), 3.5);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(UpperMedian, IsTheMiddleOrTheLargerOfTheTwoInTheMiddle) {
  EXPECT_EQ(upper_median({5.0, 1.0, 3.0}), 3.0);
  EXPECT_EQ(upper_median({4.0, 1.0, 3.0, 100.0}), 4.0);
  EXPECT_TRUE(std::isnan(upper_median({})));
}

TEST(NormalQuantile, HasTheTabulatedValues) {
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-12);
  EXPECT_NEAR(normal_quantile(0.5), 0.0, 1e-12);
  EXPECT_NEAR(normal_quantile(0.025), -1.959963984540054, 1e-12);
  EXPECT_NEAR(normal_quantile(1e-9), -5.997807015007687, 1e-11);
}

TEST(NormalQuantile, IsTheInverseOfTheDistributionFunction) {
  for (double p = 1e-300; p < 1.0; p = p < 0.01 ? p * 10.0 : p + 0.01) {
    const double x = normal_quantile(p);
    // Round-off of x alone moves p by x^2 times as much.
    EXPECT_NEAR(0.5 * std::erfc(-x / std::sqrt(2.0)) / p, 1.0, 1e-15 * (10.0 + 4.0 * x * x)) << p;
  }
}

TEST(StudentQuantile, WithOneAndTwoDegreesOfFreedomIsTheClosedForm) {
  for (const double p : {1e-6, 0.025, 0.5, 0.9, 0.9995}) {
    const double cauchy = std::tan(kPi * (p - 0.5));
    EXPECT_NEAR(student_quantile(p, 1.0), cauchy, 1e-9 * (1.0 + std::abs(cauchy))) << p;
    const double second = (2.0 * p - 1.0) / std::sqrt(2.0 * p * (1.0 - p));
    EXPECT_NEAR(student_quantile(p, 2.0), second, 1e-9 * (1.0 + std::abs(second))) << p;
  }
  EXPECT_NEAR(student_quantile(0.9995, 6.0), 5.9588, 5e-5);  // tables
  EXPECT_THROW((void)student_quantile(1.0, 5.0), InvalidInput);
  EXPECT_THROW((void)student_quantile(0.5, 0.0), InvalidInput);
}

TEST(ChiSquaredTail, WithOneTwoAndFourDegreesOfFreedomIsTheClosedForm) {
  for (const double x : {0.0, 0.1, 3.84, 30.0, 1000.0}) {
    const double tail = std::exp(-0.5 * x);
    EXPECT_NEAR(chi_squared_tail(x, 1.0) / std::erfc(std::sqrt(0.5 * x)), 1.0, 1e-11) << x;
    EXPECT_NEAR(chi_squared_tail(x, 2.0) / tail, 1.0, 1e-11) << x;
    EXPECT_NEAR(chi_squared_tail(x, 4.0) / (tail * (1.0 + 0.5 * x)), 1.0, 1e-11) << x;
  }
  EXPECT_THROW((void)chi_squared_tail(-1.0, 2.0), InvalidInput);
  EXPECT_THROW((void)chi_squared_tail(1.0, 0.0), InvalidInput);
}

TEST(EffectiveSampleSize, OfAnAutoregressiveSeriesIsTheClosedForm) {
  // rho_k = rho^k: n_eff = n (1 - rho)/(1 + rho).
  const Eigen::Index n = 200000;
  EXPECT_NEAR(effective_sample_size(autoregressive(n, 0.8), {n}) / static_cast<double>(n), 0.2 / 1.8, 0.01);
}

TEST(PositiveAutocorrelation, OfAnAutoregressiveSequenceFallsByItsFactor) {
  // rho_k = 0.8^k; each is known to some 1 / sqrt(n / 9).
  const Eigen::Index n = 200000;
  const Eigen::VectorXd rho = positive_autocorrelation(autoregressive(n, 0.8), {n});
  ASSERT_GT(rho.size(), 6);
  for (Eigen::Index k = 0; k < 6; ++k) EXPECT_NEAR(rho[k], std::pow(0.8, static_cast<double>(k)), 0.02);
  EXPECT_GT(rho.minCoeff(), 0.0);
  EXPECT_EQ(positive_autocorrelation(Eigen::VectorXd::Ones(5), {5}), Eigen::VectorXd::Ones(1));
}

TEST(MovingMean, AveragesEveryWindowByHand) {
  Eigen::VectorXd x(5);
  x << 1.0, 2.0, 6.0, 4.0, -1.0;
  const Eigen::VectorXd three = moving_mean(x, 3);
  ASSERT_EQ(three.size(), 3);
  EXPECT_NEAR(three[0], 3.0, 1e-15);
  EXPECT_NEAR(three[1], 4.0, 1e-15);
  EXPECT_NEAR(three[2], 3.0, 1e-15);
  EXPECT_TRUE(moving_mean(x, 1).isApprox(x));
}

TEST(MovingMean, TheGreatestIsOverTheWindowOrOverAllThereIs) {
  Eigen::VectorXd x(5);
  x << 1.0, 2.0, 6.0, 4.0, -1.0;
  EXPECT_NEAR(greatest_mean(x, 10.0, 0.2), 5.0, 1e-15);  // two samples: 6 and 4
  EXPECT_NEAR(greatest_mean(x, 10.0, 9.0), 2.4, 1e-15);
  EXPECT_NEAR(greatest_mean(x, 10.0, 0.0), 6.0, 1e-15);
}

TEST(ExplainedShare, IsOneMinusTheErrorsShareOfTheVariance) {
  // Residuals 1, 0, -1; deviations from the mean -3, 0, 3.
  EXPECT_DOUBLE_EQ(explained_share(Eigen::Vector3d(2, 4, 6), Eigen::Vector3d(1, 4, 7)), 1.0 - 2.0 / 18.0);
  EXPECT_LT(explained_share(Eigen::Vector3d(7, 4, 1), Eigen::Vector3d(1, 4, 7)), 0.0);
}

TEST(ExplainedShare, OfAConstantIsAboutZero) {
  EXPECT_DOUBLE_EQ(explained_share(Eigen::Vector2d(9, 11), Eigen::Vector2d(10, 10)), 0.99);
  EXPECT_EQ(explained_share(Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()), 1.0);
}

}  // namespace
}  // namespace myoid::inline ground::math
