#include "myoid/ground/math/change_points.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/random.h"

namespace myoid::inline ground::math {
namespace {

Eigen::MatrixXd noise(Eigen::Index n, Eigen::Index columns, std::uint64_t seed) {
  Random random(seed);
  Eigen::MatrixXd x(n, columns);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) x(i, j) = random.normal();
  }
  return x;
}

/// The cost of one segment from its definition, by two passes.
double direct_cost(const Eigen::MatrixXd& x, Eigen::Index begin, Eigen::Index end, const ChangePointOptions& options) {
  double cost = 0.0;
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    const Eigen::VectorXd part = x.col(j).segment(begin, end - begin);
    const double center = options.cost == SegmentCost::variance ? x.col(j).mean() : part.mean();
    const double squares = (part.array() - center).square().sum();
    const auto m = static_cast<double>(part.size());
    if (options.cost == SegmentCost::mean) {
      cost += squares / std::pow((*options.noise_sd)[j], 2);
    } else {
      const double variance = squares / m;
      cost += m * (std::log(2.0 * std::numbers::pi * variance) + 1.0);
    }
  }
  return cost;
}

TEST(ChangePoints, AreTheBestOfAllSegmentationsByBruteForce) {
  // All 2^13 ways to cut 14 samples, for each cost, one and two columns, several shortest lengths.
  const Eigen::Index n = 14;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    for (const Eigen::Index columns : {1, 2}) {
      Eigen::MatrixXd x = noise(n, columns, seed);
      x.middleRows(5, 4).array() += 2.0;
      x.bottomRows(5) *= 0.3;
      for (const SegmentCost cost : {SegmentCost::mean, SegmentCost::variance, SegmentCost::mean_and_variance}) {
        for (const Eigen::Index shortest : {2, 3, 5}) {
          const ChangePointOptions options{.cost = cost,
                                           .penalty = 3.0,
                                           .min_length = shortest,
                                           .noise_sd = Eigen::VectorXd::Constant(columns, 0.7)};
          double least = std::numeric_limits<double>::infinity();
          unsigned best = 0;
          for (unsigned cuts = 0; cuts < (1U << (n - 1)); ++cuts) {
            double total = 0.0;
            Eigen::Index begin = 0;
            bool allowed = true;
            for (Eigen::Index end = 1; end <= n && allowed; ++end) {
              if (end < n && !((cuts >> (end - 1)) & 1U)) continue;
              allowed = end - begin >= shortest;
              if (allowed) total += direct_cost(x, begin, end, options) + (begin > 0 ? 3.0 : 0.0);
              begin = end;
            }
            if (allowed && total < least) {
              least = total;
              best = cuts;
            }
          }
          const ChangePoints found = change_points(x, options);
          // The variance of two nearly equal samples, from running sums, has lost some digits.
          EXPECT_NEAR(found.cost, least, 1e-7);
          unsigned cuts = 0;
          for (const Segment& segment : found.segments) {
            if (segment.end < n) cuts |= 1U << (segment.end - 1);
          }
          EXPECT_EQ(cuts, best) << "seed " << seed << " shortest " << shortest;
        }
      }
    }
  }
}

TEST(ChangePoints, PruningLosesNothing) {
  // Optimal partitioning without pruning, from the definition of the recursion; many series, since
  // pruning that does not wait for the shortest segment goes wrong in few of them.
  const Eigen::Index n = 60;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Eigen::Index shortest = 2 + static_cast<Eigen::Index>(seed % 9);
    Eigen::MatrixXd x = noise(n, 1, seed);
    x.middleRows(20, 15).array() += 1.5;
    x.middleRows(40, 10) *= 3.0;
    const ChangePointOptions options{.penalty = 4.0, .min_length = shortest};
    std::vector<double> best(static_cast<std::size_t>(n + 1), std::numeric_limits<double>::infinity());
    best[0] = -4.0;
    for (Eigen::Index end = shortest; end <= n; ++end) {
      for (Eigen::Index begin = 0; begin + shortest <= end; ++begin) {
        best[static_cast<std::size_t>(end)] =
            std::min(best[static_cast<std::size_t>(end)],
                     best[static_cast<std::size_t>(begin)] + direct_cost(x, begin, end, options) + 4.0);
      }
    }
    EXPECT_NEAR(change_points(x, options).cost, best.back(), 1e-6) << seed;
  }
}

TEST(ChangePoints, FindsAShiftOfTheMeanWhereItIs) {
  // Three standard deviations: the place is known to a few samples.
  Eigen::MatrixXd x = noise(400, 1, 1);
  x.bottomRows(250).array() += 3.0;
  for (const SegmentCost cost : {SegmentCost::mean, SegmentCost::mean_and_variance}) {
    const ChangePoints found = change_points(x, {.cost = cost});
    ASSERT_EQ(found.segments.size(), 2U);
    EXPECT_NEAR(static_cast<double>(found.segments[1].begin), 150.0, 3.0);
    EXPECT_NEAR(found.segments[1].mean[0] - found.segments[0].mean[0], 3.0, 0.4);
    EXPECT_NEAR(found.segments[0].variance[0], 1.0, 0.35);
  }
}

TEST(ChangePoints, FindsAChangeOfTheNoiseAlone) {
  // Samples of a third of the noise may stand before the change by chance.
  for (const SegmentCost cost : {SegmentCost::variance, SegmentCost::mean_and_variance}) {
    int near = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Eigen::MatrixXd x = noise(400, 1, seed);
      x.topRows(180) *= 3.0;
      const ChangePoints found = change_points(x, {.cost = cost});
      near += found.segments.size() == 2U && std::abs(static_cast<double>(found.segments[0].end) - 180.0) <= 6.0;
    }
    EXPECT_GE(near, 15) << static_cast<int>(cost);
  }
}

TEST(ChangePoints, SeldomFindsAChangeInNoise) {
  // The criterion's false alarms are rare, not none: at most 2 of 40 series are asked.
  for (const SegmentCost cost : {SegmentCost::mean, SegmentCost::variance, SegmentCost::mean_and_variance}) {
    int alarms = 0;
    for (std::uint64_t seed = 100; seed < 140; ++seed)
      alarms += change_points(noise(500, 1, seed), {.cost = cost}).segments.size() > 1 ? 1 : 0;
    EXPECT_LE(alarms, 2) << static_cast<int>(cost);
  }
}

TEST(ChangePoints, CorrelatedNoiseNeedsItsPenaltyInflated) {
  // AR(1), rho = 0.8: n / n_eff = (1 + rho)/(1 - rho) = 9, and the noise from differences is too
  // small by sqrt(1 - rho): both are given.
  int plain = 0, inflated = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Eigen::MatrixXd x = noise(500, 1, seed);
    for (Eigen::Index i = 1; i < 500; ++i) x(i, 0) += 0.8 * x(i - 1, 0);
    ChangePointOptions options{.cost = SegmentCost::mean, .noise_sd = Eigen::VectorXd::Constant(1, 1.0 / 0.6)};
    plain += change_points(x, options).segments.size() > 1 ? 1 : 0;
    options.samples_per_independent = 9.0;
    inflated += change_points(x, options).segments.size() > 1 ? 1 : 0;
  }
  EXPECT_GE(plain, 15);
  EXPECT_LE(inflated, 2);
}

TEST(ChangePoints, AConstantSeriesAndAShortOneAreOneSegment) {
  EXPECT_EQ(change_points(Eigen::MatrixXd::Constant(50, 2, 4.0)).segments.size(), 1U);
  const ChangePoints found = change_points(noise(3, 1, 1));
  ASSERT_EQ(found.segments.size(), 1U);
  EXPECT_EQ(found.segments[0].end, 3);
}

TEST(ChangePoints, StepsWithoutNoiseAreFoundExactly) {
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(60, 1);
  x.middleRows(20, 25).array() = 1.0;
  const ChangePoints found = change_points(x);
  ASSERT_EQ(found.segments.size(), 3U);
  EXPECT_EQ(found.segments[1].begin, 20);
  EXPECT_EQ(found.segments[1].end, 45);
}

TEST(ChangePoints, RefusesWhatIsNoSeries) {
  EXPECT_THROW((void)change_points(Eigen::MatrixXd(0, 1)), InvalidInput);
  EXPECT_THROW((void)change_points(Eigen::MatrixXd::Constant(9, 1, std::nan(""))), InvalidInput);
  EXPECT_THROW((void)change_points(noise(9, 1, 1), {.penalty = -1.0}), InvalidInput);
  EXPECT_THROW((void)change_points(noise(9, 1, 1), {.min_length = 0}), InvalidInput);
  EXPECT_THROW((void)change_points(noise(9, 1, 1), {.noise_sd = Eigen::VectorXd::Ones(2)}), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground::math
