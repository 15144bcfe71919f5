#include "myoid/lab/virtual_person/raw_emg.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::lab {
namespace {

/// Returns the spectrum at a frequency, not normalized.
double power(const EmgSpectrum& spectrum, double frequency_hz) {
  const double f2 = frequency_hz * frequency_hz;
  const double low2 = spectrum.low_hz * spectrum.low_hz;
  const double high2 = spectrum.high_hz * spectrum.high_hz;
  return f2 * high2 * high2 / ((f2 + low2) * (f2 + high2) * (f2 + high2));
}

/// Returns Gaussian noise of this spectrum.
Eigen::VectorXd emg_noise(const EmgSpectrum& spectrum, double rate_hz, Eigen::Index count, math::Random& random) {
  const Eigen::Index lead = emg_lead(spectrum, rate_hz);
  return emg_from(spectrum, rate_hz, random.normals(lead + count), lead);
}

/// Power per band of `width_hz` from 0 to half the rate: squared Fourier coefficients of segments of 1/width seconds
/// (an independent, slow way: no filter of ours is involved), relative to their sum.
std::vector<double> band_shares(const Eigen::VectorXd& x, double rate_hz, double width_hz) {
  const auto length = static_cast<Eigen::Index>(rate_hz / width_hz);
  const auto bands = static_cast<std::size_t>(0.5 * rate_hz / width_hz);
  std::vector<double> result(bands, 0.0);
  double sum = 0.0;
  for (std::size_t band = 0; band < bands; ++band) {
    Eigen::VectorXd c(length);
    Eigen::VectorXd s(length);
    for (Eigen::Index k = 0; k < length; ++k) {
      const double angle = 2.0 * kPi * width_hz * static_cast<double>(band) * static_cast<double>(k) / rate_hz;
      c(k) = std::cos(angle);
      s(k) = std::sin(angle);
    }
    for (Eigen::Index start = 0; start + length <= x.size(); start += length) {
      result[band] += std::pow(c.dot(x.segment(start, length)), 2) + std::pow(s.dot(x.segment(start, length)), 2);
    }
    sum += result[band];
  }
  for (double& share : result) share /= sum;
  return result;
}

double median_hz(const std::vector<double>& shares, double width_hz) {
  double sum = 0.0;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    if (sum + shares[k] > 0.5) {
      return width_hz * (static_cast<double>(k) - 0.5 + (0.5 - sum) / shares[k]);
    }
    sum += shares[k];
  }
  return 0.0;
}

TEST(EmgNoise, HasUnitVariance) {
  // 60 s hold about 2 B T = 2 x 150 Hz x 60 s independent values: sqrt(2/18000) = 1 %; four of them.
  math::Random random(11);
  const Eigen::VectorXd noise = emg_noise({}, 1000.0, 60000, random);
  EXPECT_NEAR(noise.squaredNorm() / 60000.0, 1.0, 0.042);
  EXPECT_NEAR(noise.mean(), 0.0, 0.01);
}

TEST(EmgNoise, HasTheSpectrumOfShwedyk) {
  math::Random random(12);
  const double rate_hz = 1000.0;
  const double width_hz = 10.0;
  const std::vector<double> found = band_shares(emg_noise({}, rate_hz, 120000, random), rate_hz, width_hz);
  std::vector<double> expected(found.size());
  double sum = 0.0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    sum += expected[k] = power({}, width_hz * static_cast<double>(k));
  }
  for (double& share : expected) share /= sum;
  // The median frequency: sampling error of 1200 segments well below 1 Hz; leakage of short
  // segments and aliasing of the tail (1 % of the power) about 1 Hz.
  EXPECT_NEAR(median_hz(found, width_hz), median_hz(expected, width_hz), 3.0);
  for (std::size_t k = 2; k < 30; ++k) {
    // Each band averages 1200 exponentials: 3 %; four of them and 3 % for leakage.
    EXPECT_NEAR(found[k] / expected[k], 1.0, 0.15) << width_hz * static_cast<double>(k) << " Hz";
  }
}

TEST(EmgNoise, RefusesARateThatCannotCarryIt) {
  math::Random random(1);
  EXPECT_THROW(static_cast<void>(emg_noise({}, 400.0, 10, random)), InvalidInput);
}

TEST(DischargeNoise, IsWhiteOfUnitVarianceAndSpikyWhereDischargesAreFew) {
  // Compound Poisson of mean m a sample with normal sizes: kurtosis 3 + 3/m. 400 000 samples; the
  // fourth moment at m = 0.5 (kurtosis 9) has a relative standard error of about 2 %.
  math::Random random(5);
  const double rate_hz = 1000.0;
  for (const double mean : {0.5, 5.0}) {
    const Eigen::Index n = 400000;
    const Eigen::VectorXd noise = discharge_noise(Eigen::VectorXd::Constant(n, mean * rate_hz), rate_hz, random);
    const double variance = noise.squaredNorm() / static_cast<double>(n);
    EXPECT_NEAR(variance, 1.0, 0.02);
    const double fourth = noise.array().pow(4).sum() / static_cast<double>(n);
    EXPECT_NEAR(fourth / (3.0 + 3.0 / mean), 1.0, 0.1);
    // No sample knows the next: 1 / sqrt(n) = 0.16 %; four of them.
    EXPECT_NEAR(noise.head(n - 1).dot(noise.tail(n - 1)) / static_cast<double>(n), 0.0, 0.0064);
    const std::vector<double> shares = band_shares(noise.head(100000), rate_hz, 50.0);
    for (std::size_t k = 1; k < shares.size(); ++k)
      EXPECT_NEAR(shares[k] * 10.0, 1.0, 0.12);  // 5000 segments' exponentials, and the first band
  }
}

TEST(DischargeNoise, HalfOfTheUnitsWorkAtATenthAndAllAtSixTenths) {
  EXPECT_DOUBLE_EQ(discharges_hz(250.0, 1.0), 250.0 * 30.0);
  EXPECT_DOUBLE_EQ(discharges_hz(250.0, 0.6), 250.0 * (8.0 + 0.6 * 22.0));
  EXPECT_NEAR(discharges_hz(250.0, 0.1) / (250.0 * (8.0 + 2.2)), 0.5, 0.03);
  EXPECT_DOUBLE_EQ(discharges_hz(250.0, 0.0), 16.0);  // two units, the least
}

TEST(LowpassNoise, HasUnitVarianceAndLittleAboveItsCutoff) {
  math::Random random(13);
  const Eigen::VectorXd noise = lowpass_noise(5.0, 200.0, 80000, random);
  // Two lags at f_c have noise bandwidth pi/4 f_c: 400 s hold 2 x 3.9 x 400 values: 2.5 %; four.
  EXPECT_NEAR(noise.squaredNorm() / 80000.0, 1.0, 0.10);
  const std::vector<double> shares = band_shares(noise, 200.0, 2.0);
  double above_30_hz = 0.0;
  for (std::size_t k = 15; k < shares.size(); ++k) above_30_hz += shares[k];
  EXPECT_LT(above_30_hz, 0.01);  // 4/(3 pi) (5/30)^3 = 0.2 %, and leakage of half-second segments
}

}  // namespace
}  // namespace myoid::lab
