#include "myoid/recording/signals/spectrum.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/random.h"

namespace myoid::recording {
namespace {

constexpr double kSpectrumRate_hz = 1000.0;

Eigen::VectorXd white_noise(Eigen::Index n, std::uint64_t seed) {
  math::Random random(seed, 0);
  Eigen::VectorXd x(n);
  for (double& v : x) v = random.normal();
  return x;
}

/// First-order autoregression: its density is proportional to 1 / (1 + c^2 - 2 c cos(w)).
Eigen::VectorXd autoregression(Eigen::Index n, double c, std::uint64_t seed) {
  Eigen::VectorXd x = white_noise(n, seed);
  for (Eigen::Index i = 1; i < n; ++i) x[i] += c * x[i - 1];
  return x;
}

/// The frequency below which half of that density lies: its integral is an arc tangent,
/// (2 / (1 - c^2)) atan((1 + c) / (1 - c) tan(w / 2)), which runs to pi / 2 at w = pi.
double autoregression_median_hz(double c) {
  const double w = 2.0 * std::atan((1.0 - c) / (1.0 + c) * std::tan(std::numbers::pi / 4.0));
  return w / (2.0 * std::numbers::pi) * kSpectrumRate_hz;
}

TimeSeries one_channel(const Eigen::VectorXd& x) {
  const Eigen::Index n = x.size();
  return {Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1) / kSpectrumRate_hz), {{"m", Unit::volt}}, x};
}

TEST(PowerSpectrum, AddsUpToTheMeanSquare) {
  const Eigen::VectorXd x = 3.0 * white_noise(60000, 1);
  const PowerSpectrum s = power_spectrum(x, kSpectrumRate_hz);
  // Segments of 1 s overlapping by half weigh the samples nearly evenly; their mean is taken out of
  // each: 1 part in 1000, and the ends of the record count less.
  EXPECT_NEAR(band_power(s, 0.0, 500.0), x.squaredNorm() / 60000.0, 0.01 * 9.0);
  // White: the same density everywhere, 9 / 500; the mean over 100 bins of 119 segments is good to
  // 1 / sqrt(100 * 60) = 1.3 %.
  EXPECT_NEAR(band_power(s, 100.0, 200.0), 9.0 / 5.0, 0.05 * 9.0 / 5.0);
}

TEST(StatisticalBandwidth, IsHowFastTheMeanSquareSettles) {
  // White: half the sampling rate; the spread of a bin (120 segments) makes it 1 % less.
  EXPECT_NEAR(statistical_bandwidth_hz(power_spectrum(white_noise(60000, 3), kSpectrumRate_hz)), 500.0, 15.0);
  // First-order autoregression: variance^2 over the sum of squared autocovariances c^2k, 500 (1 - c^2) / (1 + c^2).
  const double c = 0.7;
  EXPECT_NEAR(statistical_bandwidth_hz(power_spectrum(autoregression(60000, c, 4), kSpectrumRate_hz)),
              500.0 * (1.0 - c * c) / (1.0 + c * c), 10.0);
}

TEST(PowerSpectrum, ASineHasHalfItsSquaredAmplitudeAtItsFrequency) {
  Eigen::VectorXd x(5000);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    x[i] = 5.0 + 2.0 * std::sin(2.0 * std::numbers::pi * 50.3 * static_cast<double>(i) / kSpectrumRate_hz);
  }
  const PowerSpectrum s = power_spectrum(x, kSpectrumRate_hz);
  // The side lobes of the Hann window fall with the third power: beyond 5 bins less than 1e-3 is left.
  EXPECT_NEAR(band_power(s, 45.0, 56.0), 2.0, 0.01);
  EXPECT_LT(band_power(s, 0.0, 5.0), 1e-3);
}

TEST(PowerSpectrum, ASignalShorterThanASegmentIsOneSegment) {
  const Eigen::VectorXd x = white_noise(300, 4);
  EXPECT_EQ(power_spectrum(x, kSpectrumRate_hz, 1.0).density.size(), 151);
  EXPECT_THROW(static_cast<void>(power_spectrum(x.head(7), kSpectrumRate_hz)), InvalidInput);
  EXPECT_THROW(static_cast<void>(power_spectrum(x, 0.0)), InvalidInput);
}

TEST(MedianFrequency, OfAnAutoregressionIsItsClosedForm) {
  for (const double c : {0.0, 0.5, 0.8}) {
    const Eigen::VectorXd x = autoregression(120000, c, 2);
    const PowerSpectrum s = power_spectrum(x, kSpectrumRate_hz, 1.0);
    // Without the bins at 0, which lose the mean: 1 part in 500. The spread of the estimate is
    // about 1 / sqrt(2 B T) of the band, below 1 %.
    EXPECT_NEAR(median_frequency_hz(s, 0.0, 500.0), autoregression_median_hz(c),
                0.015 * autoregression_median_hz(c) + 0.5)
        << c;
  }
}

TEST(MedianFrequency, HalvesTheBandOfWhiteNoise) {
  const PowerSpectrum s = power_spectrum(white_noise(120000, 3), kSpectrumRate_hz);
  EXPECT_NEAR(median_frequency_hz(s, 20.0, 400.0), 210.0, 3.0);
  EXPECT_TRUE(std::isnan(median_frequency_hz(
      {.frequency_hz = Eigen::Vector3d(0.0, 1.0, 2.0), .density = Eigen::Vector3d::Zero()}, 0.0, 2.0)));
}

TEST(MedianFrequency, FollowsASpectrumThatShiftsAndLeavesOutWindowsAtRest) {
  Eigen::VectorXd x(30000);
  x.head(10000) = autoregression(10000, 0.3, 5);
  x.segment(10000, 10000) = autoregression(10000, 0.8, 6);
  x.tail(10000) = 0.05 * white_noise(10000, 7);
  const TimeSeries m = median_frequency(
      one_channel(x),
      {.window_s = 2.0, .low_hz = 20.0, .high_hz = 450.0, .resting_rms = Eigen::VectorXd::Constant(1, 0.05)});
  ASSERT_EQ(m.sample_count(), 15);
  EXPECT_NEAR(m.time_s()[0], 0.9995, 1e-9);
  EXPECT_EQ(m.channels()[0].unit, Unit::hertz);
  for (Eigen::Index w = 0; w < 5; ++w) EXPECT_GT(m.values()(w, 0), 120.0);
  for (Eigen::Index w = 5; w < 10; ++w) EXPECT_LT(m.values()(w, 0), 90.0);
  for (Eigen::Index w = 10; w < 15; ++w) EXPECT_TRUE(std::isnan(m.values()(w, 0)));
}

}  // namespace
}  // namespace myoid::recording
