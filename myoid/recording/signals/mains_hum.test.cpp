#include "myoid/recording/signals/mains_hum.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"
#include "myoid/ground/math/random.h"

namespace myoid::recording {
namespace {

constexpr double kHumRate_hz = 1000.0;

/// White noise of rms 1 whose loudness comes and goes, as a muscle's does.
Eigen::VectorXd bursts(Eigen::Index n, std::uint64_t seed) {
  math::Random random(seed);
  Eigen::VectorXd x(n);
  for (Eigen::Index i = 0; i < n; ++i) x[i] = random.normal() * (1.0 + std::sin(0.004 * static_cast<double>(i)));
  return x;
}

Eigen::VectorXd sine(Eigen::Index n, double frequency_hz, double amplitude) {
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(n, 0.0, static_cast<double>(n - 1) / kHumRate_hz);
  return (amplitude * (2.0 * kPi * frequency_hz * t + 0.3).sin()).matrix();
}

TEST(MainsHum, IsNotHeardInEmgAlone) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto hum = find_hum(bursts(20000, seed), kHumRate_hz);
    EXPECT_TRUE(!hum || hum->share < 0.01) << seed << ' ' << hum->share;
  }
  EXPECT_FALSE(find_hum(bursts(1000, 1), kHumRate_hz));
  EXPECT_FALSE(find_hum(Eigen::VectorXd::Zero(5000), kHumRate_hz));
}

TEST(MainsHum, ItsShareOfThePowerAndItsHarmonicsAreFound) {
  // Bursts of power 1.5, of which (450 - 20)/500 lie in the band; sines of power 0.5 and 0.125.
  const Eigen::VectorXd x = bursts(40000, 3) + sine(40000, 60.0, 1.0) + sine(40000, 180.0, 0.5);
  const auto hum = find_hum(x, kHumRate_hz);
  ASSERT_TRUE(hum);
  EXPECT_EQ(hum->mains_hz, 60.0);
  EXPECT_EQ(hum->lines_hz, (std::vector<double>{60.0, 180.0}));
  const double expected = 0.625 / (1.5 * 430.0 / 500.0 + 0.625);
  EXPECT_NEAR(hum->share, expected, 0.03);
}

TEST(MainsHum, TheNotchTakesTheLineAndLeavesTheRest) {
  const Eigen::VectorXd emg = bursts(40000, 4);
  const Hum hum{.mains_hz = 50.0, .lines_hz = {50.0}, .share = 0.5};
  const Eigen::Index cut = 2000;  // the notch rings for 1/(pi 4 Hz) = 0.08 s
  const Eigen::VectorXd line = without_hum(sine(40000, 50.0, 1.0), kHumRate_hz, hum);
  EXPECT_LT(line.segment(cut, 36000).cwiseAbs().maxCoeff(), 1e-3);
  // Also at the ends, where the line is extrapolated.
  EXPECT_LT(line.cwiseAbs().maxCoeff(), 1e-3);
  const Eigen::VectorXd rest = without_hum(emg, kHumRate_hz, hum);
  // Two passes of 4 Hz at -3 dB take the share pi/2 * 4 * 3/2 / 2 ... of 500 Hz: about 2 %.
  const double left = rest.squaredNorm() / emg.squaredNorm();
  EXPECT_GT(left, 0.97);
  EXPECT_LT(left, 1.0);
  // No delay: a sine beside the notch keeps its phase.
  const Eigen::VectorXd beside = sine(40000, 120.0, 1.0);
  EXPECT_LT((without_hum(beside, kHumRate_hz, hum) - beside).segment(cut, 36000).cwiseAbs().maxCoeff(), 0.01);
}

}  // namespace
}  // namespace myoid::recording
