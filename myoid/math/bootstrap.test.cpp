#include "myoid/math/bootstrap.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "myoid/core/error.h"
#include "myoid/math/statistics.h"

namespace myoid::math {
namespace {

Eigen::VectorXd autoregressive(Eigen::Index n, double rho, std::uint64_t seed) {
  Random random(seed);
  Eigen::VectorXd x(n);
  double last = random.normal() / std::sqrt(1.0 - rho * rho);
  for (double& v : x) v = last = rho * last + random.normal();
  return x;
}

BootstrapResult bootstrap_of_mean(const Eigen::VectorXd& x,
                                  const std::vector<Eigen::Index>& pieces,
                                  Eigen::Index length,
                                  BlockScheme scheme,
                                  const BootstrapOptions& options) {
  return bootstrap(
      [&](Random& random) { return block_bootstrap_indices(pieces, length, scheme, random); },
      [&](const std::vector<Eigen::Index>& indices) {
        double sum = 0.0;
        for (const Eigen::Index i : indices) sum += x[i];
        return std::optional<Eigen::VectorXd>(
            Eigen::VectorXd::Constant(1, sum / static_cast<double>(indices.size())));
      },
      options);
}

TEST(BlockBootstrap, VarianceOfAMeanIsItsClosedFormGivenTheSample) {
  // n/b independent blocks, each uniform over its starts: Var = (b/n) Var(block means), exactly.
  // 4000 replicates know a variance to sqrt(2/4000) = 2.2 %; five of those are allowed.
  const Eigen::Index n = 240, b = 12;
  const Eigen::VectorXd x = autoregressive(n, 0.7, 1);
  for (const BlockScheme scheme : {BlockScheme::moving, BlockScheme::circular}) {
    const Eigen::Index starts = scheme == BlockScheme::moving ? n - b + 1 : n;
    Eigen::VectorXd means = Eigen::VectorXd::Zero(starts);
    for (Eigen::Index s = 0; s < starts; ++s) {
      for (Eigen::Index k = 0; k < b; ++k) means[s] += x[(s + k) % n] / static_cast<double>(b);
    }
    const double mean = means.mean();
    const double variance = (means.array() - mean).square().mean() * 12.0 / 240.0;
    const BootstrapResult result = bootstrap_of_mean(x, {n}, b, scheme, {.replicates = 4000});
    EXPECT_NEAR(result.covariance()(0, 0) / variance, 1.0, 0.11);
    EXPECT_NEAR(result.mean()[0], mean, 5.0 * std::sqrt(variance / 4000.0));
    if (scheme == BlockScheme::circular) {
      EXPECT_NEAR(mean, x.mean(), 1e-12);
    }
  }
}

TEST(BlockBootstrap, SeesTheCorrelationThatSingleSamplesMiss) {
  // AR(1), rho = 0.9: the mean's variance is sigma^2/((1-rho)^2 n) = 100/n, and 5.26/n if samples
  // were independent. Blocks of 100 see most of it (Bartlett bias about 2 rho/(1-rho^2)/b = 10 %);
  // the sample's own spectrum at zero, from n/b = 200 blocks, is known to 10 %: 3 of both.
  const Eigen::Index n = 20000;
  const Eigen::VectorXd x = autoregressive(n, 0.9, 2);
  for (const BlockScheme scheme :
       {BlockScheme::moving, BlockScheme::circular, BlockScheme::stationary}) {
    const double variance =
        bootstrap_of_mean(x, {n}, 100, scheme, {.replicates = 300}).covariance()(0, 0) * 20000.0;
    EXPECT_NEAR(variance, 95.0, 35.0);
  }
  const double single =
      bootstrap_of_mean(x, {n}, 1, BlockScheme::moving, {.replicates = 300}).covariance()(0, 0) *
      20000.0;
  EXPECT_NEAR(single, 5.26, 1.5);
}

TEST(BlockBootstrap, StationaryBlocksHaveTheirMeanLength) {
  // A step to the next sample (around the end) has probability 1 - p + p/n, p = 1/b.
  Random random(3);
  const Eigen::Index n = 1000;
  int follow = 0, total = 0;
  for (int k = 0; k < 50; ++k) {
    const auto indices = block_bootstrap_indices({n}, 20, BlockScheme::stationary, random);
    for (std::size_t i = 1; i < indices.size(); ++i, ++total)
      follow += indices[i] == (indices[i - 1] + 1) % n ? 1 : 0;
  }
  const double p = 1.0 - 0.05 + 0.05 / 1000.0;
  EXPECT_NEAR(static_cast<double>(follow) / total, p, 5.0 * std::sqrt(p * (1.0 - p) / total));
}

TEST(BlockBootstrap, BlocksNeverJoinOrLeaveTrials) {
  Random random(4);
  const std::vector<Eigen::Index> pieces{7, 0, 30, 3};
  for (const BlockScheme scheme :
       {BlockScheme::moving, BlockScheme::circular, BlockScheme::stationary}) {
    for (int k = 0; k < 200; ++k) {
      const auto indices = block_bootstrap_indices(pieces, 10, scheme, random);
      ASSERT_EQ(indices.size(), 40U);
      for (std::size_t i = 0; i < 40; ++i) {
        const Eigen::Index first = i < 7 ? 0 : i < 37 ? 7 : 37;
        const Eigen::Index last = i < 7 ? 7 : i < 37 ? 37 : 40;
        EXPECT_GE(indices[i], first);
        EXPECT_LT(indices[i], last);
      }
      if (scheme == BlockScheme::moving) {
        for (std::size_t i = 0; i < 7; ++i)  // a piece shorter than a block is one block
          EXPECT_EQ(indices[i], static_cast<Eigen::Index>(i));
      }
    }
  }
}

TEST(ClusterBootstrap, VarianceOfAMeanOfClustersIsItsClosedForm) {
  const Eigen::VectorXd means = autoregressive(9, 0.0, 5);
  const double variance = (means.array() - means.mean()).square().mean() / 9.0;
  const BootstrapResult result =
      bootstrap([](Random& random) { return cluster_bootstrap_indices(9, random); },
                [&](const std::vector<Eigen::Index>& drawn) {
                  double sum = 0.0;
                  for (const Eigen::Index k : drawn) sum += means[k];
                  return std::optional<Eigen::VectorXd>(Eigen::VectorXd::Constant(1, sum / 9.0));
                },
                {.replicates = 4000});
  EXPECT_NEAR(result.covariance()(0, 0) / variance, 1.0, 0.11);
  EXPECT_NEAR(result.mean()[0], means.mean(), 5.0 * std::sqrt(variance / 4000.0));
}

TEST(BlockLength, OfAnAutoregressiveSeriesIsTheClosedForm) {
  // G/g = 2 rho/(1-rho^2): b = (6 rho^2/(1-rho^2)^2 n)^(1/3) circular, (4 ... n)^(1/3) stationary.
  // The flat-top estimate of G at n = 50000 is known to about 10 %.
  const Eigen::Index n = 50000;
  for (const double rho : {0.3, 0.8}) {
    const Eigen::VectorXd x = autoregressive(n, rho, 6);
    const double ratio = rho / (1.0 - rho * rho);
    EXPECT_NEAR(
        block_length(x, {n}, BlockScheme::circular) / std::cbrt(6.0 * ratio * ratio * 50000.0), 1.0,
        0.2);
    EXPECT_NEAR(block_length(x, {n / 2, n / 2}, BlockScheme::stationary) /
                    std::cbrt(4.0 * ratio * ratio * 50000.0),
                1.0, 0.2);
  }
  EXPECT_LT(block_length(autoregressive(n, 0.0, 7), {n}, BlockScheme::moving), 6.0);
  EXPECT_EQ(block_length(Eigen::VectorXd::Ones(50), {50}, BlockScheme::moving), 1.0);
}

TEST(Bootstrap, IsTheSameOnOneThreadAndOnManyAndCountsFailures) {
  const Eigen::VectorXd x = autoregressive(60, 0.5, 8);
  const auto run = [&] {
    return bootstrap(
        [](Random& random) {
          return block_bootstrap_indices({60}, 6, BlockScheme::stationary, random);
        },
        [&](const std::vector<Eigen::Index>& indices) -> std::optional<Eigen::VectorXd> {
          if (indices.front() % 4 == 0) return std::nullopt;
          return Eigen::Vector2d(x[indices.front()], x[indices.back()]);
        },
        {.replicates = 6000, .seed = 11});
  };
  const BootstrapResult many = run();
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const BootstrapResult single = run();
  EXPECT_EQ(many.estimates, single.estimates);
  EXPECT_EQ(many.failed, single.failed);
  EXPECT_EQ(many.failed + many.estimates.rows(), 6000);
  EXPECT_NEAR(static_cast<double>(many.failed), 1500.0, 170.0);
}

TEST(BcaInterval, WithoutBiasAndSkewIsThePercentileInterval) {
  Eigen::VectorXd symmetric(999);
  for (Eigen::Index i = 0; i < 999; ++i)
    symmetric[i] = normal_quantile(static_cast<double>(i + 1) / 1000.0);
  symmetric[499] = 0.0;  // a tie with the estimate counts by half
  const BootstrapInterval plain = percentile_interval(symmetric, 0.95);
  EXPECT_NEAR(plain.lower, -1.959963984540054, 1e-9);
  EXPECT_NEAR(plain.upper, 1.959963984540054, 1e-9);
  const auto bca = bca_interval(symmetric, 0.0, Eigen::Vector3d(-1.0, 0.0, 1.0), 0.95);
  ASSERT_TRUE(bca.has_value());
  EXPECT_NEAR(bca->lower, plain.lower, 1e-9);
  EXPECT_NEAR(bca->upper, plain.upper, 1e-9);
}

TEST(BcaInterval, OfNormalReplicatesHasItsClosedForm) {
  // Replicates N(0, 1) about an estimate e: z0 = e, and a from the jackknife; the ends are
  // z0 + (z0 + z)/(1 - a (z0 + z)). Between 1999 order statistics a normal is linear to 1e-3.
  Eigen::VectorXd replicates(1999);
  for (Eigen::Index i = 0; i < replicates.size(); ++i)
    replicates[i] = normal_quantile(static_cast<double>(i + 1) / 2000.0);
  const Eigen::Vector4d jackknife(0.0, 0.0, 0.0, -4.0);  // d = -1, -1, -1, 3: a = 24/(6 12^1.5)
  const double a = 24.0 / (6.0 * std::pow(12.0, 1.5)), e = 0.2, z = 1.6448536269514722;
  const auto bca = bca_interval(replicates, e, jackknife, 0.9);
  ASSERT_TRUE(bca.has_value());
  EXPECT_NEAR(bca->lower, e + (e - z) / (1.0 - a * (e - z)), 1e-3);
  EXPECT_NEAR(bca->upper, e + (e + z) / (1.0 - a * (e + z)), 1e-3);
  EXPECT_FALSE(bca_interval(replicates, 9.0, jackknife, 0.9).has_value());
}

TEST(Bootstrap, RefusesBadRequests) {
  Random random(1);
  EXPECT_THROW((void)block_bootstrap_indices({5}, 0, BlockScheme::moving, random), InvalidInput);
  EXPECT_THROW((void)block_bootstrap_indices({-5}, 2, BlockScheme::moving, random), InvalidInput);
  EXPECT_THROW((void)cluster_bootstrap_indices(0, random), InvalidInput);
  EXPECT_THROW((void)block_length(Eigen::VectorXd::Ones(5), {4}, BlockScheme::moving),
               InvalidInput);
  EXPECT_THROW((void)percentile_interval(Eigen::VectorXd::Ones(1), 0.95), InvalidInput);
  EXPECT_THROW((void)percentile_interval(Eigen::VectorXd::Ones(9), 95.0), InvalidInput);
}

}  // namespace
}  // namespace myoid::math
