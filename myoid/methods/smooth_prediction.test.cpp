#include "myoid/methods/smooth_prediction.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "myoid/core/units.h"
#include "myoid/intervals/score.h"

namespace myoid::identification {
namespace {

constexpr double kRate_hz = 100.0;
constexpr Eigen::Index kCount = 2000;

constexpr EnvelopeNoise kOne{.variance_nm2 = 1.0, .cutoff_hz = 6.0};

Eigen::VectorXd clock() { return Eigen::VectorXd::LinSpaced(kCount, 0.0, 19.99); }

Eigen::VectorXd wave(double hz) { return (10.0 * (2.0 * kPi * hz * clock().array()).sin()).matrix(); }

/// White noise below 6 Hz, of this standard deviation.
Eigen::VectorXd noise(double sd, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd x(kCount);
  for (double& v : x) v = normal(engine);
  x = below(clock(), x, 6.0);
  return x * (sd / std::sqrt(x.squaredNorm() / static_cast<double>(kCount)));
}

double error(const Eigen::VectorXd& x, const Eigen::VectorXd& truth) {
  return (x - truth).squaredNorm() / static_cast<double>(kCount);
}

TEST(SmoothPrediction, ComesCloseToTheBestCutOffWithoutKnowingTheTruth) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Eigen::VectorXd truth = wave(0.5) + 0.2 * wave(1.0);
    const Eigen::VectorXd noisy = truth + noise(2.0, seed);
    const SmoothPrediction found = smooth_prediction(clock(), noisy, {.variance_nm2 = 4.0, .cutoff_hz = 6.0});
    double least = error(noisy, truth);
    for (double hz = 0.7; hz < 6.0; hz *= 1.05) least = std::min(least, error(below(clock(), noisy, hz), truth));
    // 20 s of noise below 6 Hz are 240 independent values: the risk is known to 10 % of the noise.
    EXPECT_LT(error(found.torque_nm, truth), least + 0.1 * 4.0) << seed;
    EXPECT_LT(error(found.torque_nm, truth), 0.5 * 4.0) << seed;
  }
}

TEST(ShareBehindLags, IsThatOfWhiteNoiseBehindTheSameFilters) {
  constexpr double kTau_s = 0.04;
  const double share = share_behind_lags({.variance_nm2 = 1.0, .cutoff_hz = 6.0, .lag_s = {kTau_s, kTau_s}});
  double before = 0.0, behind = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Eigen::VectorXd x = noise(1.0, seed);
    before += x.squaredNorm();
    double first = 0.0, second = 0.0;
    const double step = 1.0 - std::exp(-1.0 / (kRate_hz * kTau_s));
    for (const double value : x) {
      first += (value - first) * step;
      second += (first - second) * step;
      behind += second * second;
    }
  }
  // 20 x 240 independent values: 2 %; steps of 10 ms in lags of 40 ms.
  EXPECT_NEAR(share, behind / before, 0.04);
  EXPECT_EQ(share_behind_lags({.variance_nm2 = 1.0, .cutoff_hz = 6.0}), 1.0);
}

TEST(SmoothPrediction, NoiseThatPassedLagsIsSmoothedAsItIsBehindThem) {
  // Two lags of 40 ms keep 54 % of the noise's variance, mostly of its slow part: taken for noise
  // without lags it would cost more of the movement than of the noise.
  constexpr double kTau_s = 0.04;
  constexpr EnvelopeNoise kLagged{.variance_nm2 = 4.0, .cutoff_hz = 6.0, .lag_s = {kTau_s, kTau_s}};
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Eigen::VectorXd truth = wave(0.5) + 0.2 * wave(2.0);
    Eigen::VectorXd behind = noise(2.0, seed);
    for (int pass = 0; pass < 2; ++pass) {
      double state = behind[0];
      for (double& x : behind) {
        state += (x - state) * (1.0 - std::exp(-1.0 / (kRate_hz * kTau_s)));
        x = state;
      }
    }
    const Eigen::VectorXd noisy = truth + behind;
    const SmoothPrediction found = smooth_prediction(clock(), noisy, kLagged);
    double least = error(noisy, truth);
    for (double hz = 0.7; hz < 6.0; hz *= 1.05) least = std::min(least, error(below(clock(), noisy, hz), truth));
    EXPECT_LT(error(found.torque_nm, truth), least + 0.1 * 4.0) << seed;
    const SmoothPrediction blind = smooth_prediction(clock(), noisy, {.variance_nm2 = 4.0, .cutoff_hz = 6.0});
    EXPECT_GT(found.cutoff_hz, blind.cutoff_hz) << seed;
  }
}

TEST(SmoothPrediction, AFastMovementKeepsMoreOfItsBand) {
  const double slow = smooth_prediction(clock(), wave(0.3) + noise(1.0, 3), kOne).cutoff_hz;
  const double fast = smooth_prediction(clock(), wave(2.0) + noise(1.0, 3), kOne).cutoff_hz;
  EXPECT_GT(slow, 0.0);
  EXPECT_GT(fast, 1.5 * slow);
}

TEST(SmoothPrediction, WithoutNoiseOrOnAClockTooSlowNothingChanges) {
  const Eigen::VectorXd truth = wave(0.5);
  EXPECT_EQ(smooth_prediction(clock(), truth, {.cutoff_hz = 6.0}).torque_nm, truth);
  EXPECT_EQ(smooth_prediction(clock(), truth, {.cutoff_hz = 6.0}).cutoff_hz, 0.0);
  const Eigen::VectorXd days = clock() * 1e3;
  EXPECT_EQ(smooth_prediction(days, truth, kOne).torque_nm, truth);
}

}  // namespace
}  // namespace myoid::identification
