#include "myoid/recording/signals/emg_measures.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "myoid/recording/signals/emg_envelope.h"

namespace myoid::recording {
namespace {

TimeSeries burst_channel(const Eigen::VectorXd& x, double rate_hz) {
  return {Eigen::VectorXd::LinSpaced(x.size(), 0.0, static_cast<double>(x.size() - 1) / rate_hz),
          {{"TA", Unit::volt}},
          Eigen::MatrixXd(x)};
}

TEST(EmgMeasures, TheOnsetOfABurstIsFoundToSomeMilliseconds) {
  // Noise of 3 uV, and bursts of 100 uV from 2 to 2.5 s and from 4 to 4.8 s. The low-pass of 25 Hz begins some 15 ms
  // early; five standard deviations of the rest are reached within 10 ms of a burst that is 30 times as strong.
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  Eigen::VectorXd x(8000);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double t = 0.001 * static_cast<double>(i);
    const bool works = (t >= 2.0 && t < 2.5) || (t >= 4.0 && t < 4.8);
    x[i] = (works ? 1e-4 : 3e-6) * normal(engine);
  }
  const std::vector<EmgBurst> found = emg_bursts(burst_channel(x, 1000.0), 0);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].onset_s, 2.0, 0.025);
  EXPECT_NEAR(found[0].end_s, 2.5, 0.025);
  EXPECT_NEAR(found[1].onset_s, 4.0, 0.025);
  EXPECT_NEAR(found[1].end_s, 4.8, 0.025);
}

TEST(EmgMeasures, OfSinesRmsAndMedianFrequencyAreKnown) {
  // A sine of amplitude A has rms A / sqrt(2), and its own frequency; a bin is 4 Hz wide.
  Eigen::VectorXd x(4000);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double t = 0.001 * static_cast<double>(i);
    x[i] = t < 2.0 ? 2e-4 * std::sin(2.0 * M_PI * 80.0 * t) : 1e-4 * std::sin(2.0 * M_PI * 120.0 * t);
  }
  const std::vector<EmgWindow> windows = emg_windows(burst_channel(x, 1000.0), 0, 1.0);
  ASSERT_EQ(windows.size(), 4U);
  EXPECT_NEAR(windows[0].rms, 2e-4 / std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(windows[3].rms, 1e-4 / std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(windows[0].median_frequency_hz, 80.0, 4.0);
  EXPECT_NEAR(windows[3].median_frequency_hz, 120.0, 4.0);
  EXPECT_EQ(windows[1].begin_s, 1.0);
  EXPECT_EQ(windows[1].end_s, 2.0);
}

}  // namespace
}  // namespace myoid::recording
