#include "myoid/recording/signals/emg_spikes.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"
#include "myoid/ground/math/random.h"

namespace myoid::recording {
namespace {

constexpr double kSpikeRate_hz = 2000.0;

/// White noise of 20 uV rms with a burst of 200 uV in the middle second of three.
Eigen::VectorXd noise_and_burst(std::uint64_t seed) {
  math::Random random(seed);
  Eigen::VectorXd x(6000);
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = (i / 2000 == 1 ? 2e-4 : 2e-5) * random.normal();
  return x;
}

TEST(EmgSpikes, ASampleFarBeyondTheOthersIsFoundWithItsHeightAndReplacedByALine) {
  for (const Eigen::Index at : {0, 700, 3000, 5999}) {
    Eigen::VectorXd x = noise_and_burst(1);
    const Eigen::VectorXd clean = x;
    x[at] += 0.05;
    const std::vector<EmgSpike> spikes = find_spikes(x, kSpikeRate_hz);
    ASSERT_EQ(spikes.size(), 1U) << at;
    EXPECT_EQ(spikes[0].peak, at);
    EXPECT_EQ(spikes[0].length, 1);
    EXPECT_NEAR(spikes[0].height, 0.05, 1e-3);
    const Eigen::VectorXd mended = without_spikes(x, spikes);
    const double left = at > 0 ? clean[at - 1] : clean[at + 1];
    const double right = at < 5999 ? clean[at + 1] : clean[at - 1];
    EXPECT_NEAR(mended[at], 0.5 * (left + right), 1e-15);
    EXPECT_EQ((mended - clean).cwiseAbs().sum(), std::abs(mended[at] - clean[at]));
  }
}

TEST(EmgSpikes, TwoSamplesOfOppositeSignAreOneSpikeAndManySpikesAreEachFound) {
  Eigen::VectorXd x = noise_and_burst(2);
  for (Eigen::Index i = 200; i < 6000; i += 250) {  // 8 a second
    x[i] = 3e-2;
    x[i + 1] = -2e-2;
  }
  const std::vector<EmgSpike> spikes = find_spikes(x, kSpikeRate_hz);
  EXPECT_EQ(spikes.size(), 24U);
  EXPECT_LT(without_spikes(x, spikes).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(EmgSpikes, WhatIsWiderThanAMillisecondIsNone) {
  // Noise alone; the potential of a motor unit, half as wide as the shortest ones; a step of the baseline.
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_TRUE(find_spikes(noise_and_burst(seed), kSpikeRate_hz).empty());
  Eigen::VectorXd x = noise_and_burst(3);
  for (Eigen::Index i = -20; i <= 20; ++i) x[500 + i] += 2e-3 * std::exp(-0.5 * std::pow(0.5 * double(i) / 1.0, 2.0));
  EXPECT_TRUE(find_spikes(x, kSpikeRate_hz).empty());
  x.tail(2000).array() += 0.1;
  EXPECT_TRUE(find_spikes(x, kSpikeRate_hz).empty());
}

TEST(EmgSpikes, TheWarningNamesTheHighest) {
  const Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(100, 0.0, 9.9);
  const Remark remark =
      spike_remark("VL", time_s, {{.begin = 3, .peak = 3, .height = 0.01}, {.begin = 40, .peak = 40, .height = 0.05}});
  EXPECT_NE(remark.says.find("50 mV at 4 s"), std::string::npos) << remark.says;
}

}  // namespace
}  // namespace myoid::recording
