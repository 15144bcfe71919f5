#include "myoid/math/statistics.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace myoid::math {
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

TEST(NormalQuantile, HasTheTabulatedValues) {
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-12);
  EXPECT_NEAR(normal_quantile(0.5), 0.0, 1e-12);
}

TEST(EffectiveSampleSize, OfAnAutoregressiveSeriesIsTheClosedForm) {
  // rho_k = rho^k: n_eff = n (1 - rho)/(1 + rho).
  const Eigen::Index n = 200000;
  EXPECT_NEAR(effective_sample_size(autoregressive(n, 0.8), {n}) / static_cast<double>(n),
              0.2 / 1.8, 0.01);
}

TEST(NeweyWest, OfAnAutoregressiveScoreTendsToItsLongRunVariance) {
  // Variance of the sum per sample: sigma^2 / (1 - rho)^2 = 4 for rho = 0.5.
  const Eigen::Index n = 200000;
  const Eigen::MatrixXd b = newey_west(autoregressive(n, 0.5), {n}, 100);
  EXPECT_NEAR(b(0, 0) / static_cast<double>(n), 4.0, 0.25);  // Bartlett's bias 1/L and the noise
}

TEST(NeweyWest, DoesNotJoinTheEndOfOneTrialToTheNext) {
  Eigen::MatrixXd x(4, 1);
  x << 1, 0, 1, 0;
  EXPECT_EQ(newey_west(x, {1, 1, 1, 1}, 3)(0, 0), 2.0);
  EXPECT_GT(newey_west(x, {4}, 3)(0, 0), 2.0);
}

}  // namespace
}  // namespace myoid::math
