#include "myoid/recording/signals/ecg.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "myoid/recording/signals/emg_envelope.h"
#include "myoid/recording/signals/emg_quality.h"

namespace myoid::recording {
namespace {

constexpr double kEcgSampling_hz = 1000.0;

/// A QRS complex of 80 ms: a small wave down, a large one up, one down [of height 1].
double heart(double t_s) {
  const auto wave = [&](double at, double width, double height) {
    return height * std::exp(-0.5 * std::pow((t_s - at) / width, 2));
  };
  return wave(-0.025, 0.008, -0.2) + wave(0.0, 0.011, 1.0) + wave(0.03, 0.010, -0.35) + wave(0.25, 0.04, 0.25);
}

/// Beats at 1.2 Hz with 3 % of irregularity, of this height [V], and where they are.
Eigen::VectorXd beating(Eigen::Index n, double height_v, unsigned seed, std::vector<double>* times = nullptr) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  for (double at = 0.4; at < static_cast<double>(n) / kEcgSampling_hz; at += (1.0 + 0.03 * normal(engine)) / 1.2) {
    if (times != nullptr) times->push_back(at);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double t = static_cast<double>(i) / kEcgSampling_hz - at;
      if (std::abs(t) < 0.5) x[i] += height_v * heart(t);
    }
  }
  return x;
}

/// White noise whose strength goes up and down, as a muscle at work at 1 Hz.
Eigen::VectorXd muscle_at_work(Eigen::Index n, double rms_v, double bursts_hz, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd x(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double phase = std::sin(2.0 * M_PI * bursts_hz * static_cast<double>(i) / kEcgSampling_hz);
    x[i] = rms_v * (bursts_hz > 0.0 ? (phase > 0.5 ? 1.0 : 0.1) : 1.0) * normal(engine);
  }
  return x;
}

TEST(Ecg, TheHeartInAQuietTrunkMuscleIsFoundWithItsRate) {
  std::vector<double> times;
  const Eigen::VectorXd x = beating(30000, 3e-4, 1, &times) + muscle_at_work(30000, 2e-5, 0.0, 2);
  const auto found = find_ecg(x, kEcgSampling_hz);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->rate_hz, 1.2, 0.05);
  ASSERT_NEAR(static_cast<double>(found->at.size()), static_cast<double>(times.size()), 1.0);
  for (const Eigen::Index at : found->at) {
    double nearest = 1.0;
    for (const double time : times)
      nearest = std::min(nearest, std::abs(time - static_cast<double>(at) / kEcgSampling_hz));
    EXPECT_LT(nearest, 0.03);
  }
}

TEST(Ecg, BurstsOfAMuscleAreNoHeart) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    EXPECT_FALSE(find_ecg(muscle_at_work(30000, 1e-4, 1.0, seed), kEcgSampling_hz)) << seed;
    EXPECT_FALSE(find_ecg(muscle_at_work(30000, 1e-4, 0.0, seed), kEcgSampling_hz)) << seed;
  }
}

TEST(Ecg, HumAndTonesAreNoHeart) {
  for (const double hz : {12.0, 50.0, 60.0, 80.0}) {
    Eigen::VectorXd x = muscle_at_work(30000, 1e-6, 0.0, 5);
    for (Eigen::Index i = 0; i < x.size(); ++i)
      x[i] += 1e-4 * std::sin(2.0 * M_PI * hz * static_cast<double>(i) / kEcgSampling_hz);
    EXPECT_FALSE(find_ecg(x, kEcgSampling_hz)) << hz;
  }
}

TEST(Ecg, TakenOutItLeavesTheMuscle) {
  // The muscle is white noise of 20 uV; the heart has ten times that and a rms of 34 uV.
  const Eigen::VectorXd muscle = muscle_at_work(60000, 2e-5, 0.0, 3);
  const Eigen::VectorXd x = beating(60000, 2e-4, 4) + muscle;
  const auto beats = find_ecg(x, kEcgSampling_hz);
  ASSERT_TRUE(beats);
  const Eigen::VectorXd clean = without_ecg(x, kEcgSampling_hz, *beats);
  const auto rms = [](const Eigen::VectorXd& v) { return std::sqrt(v.squaredNorm() / static_cast<double>(v.size())); };
  const double heart_before = rms(x - muscle), heart_behind = rms(clean - muscle);
  EXPECT_LT(heart_behind, 0.35 * heart_before);
  // 0.35 of the heart's 34 uV beside the muscle's 20 uV: sqrt(1 + 0.6^2) at most.
  EXPECT_NEAR(rms(clean) / rms(muscle), 1.0, 0.17);
  const TimeSeries raw(Eigen::VectorXd::LinSpaced(60000, 0.0, 59.999), {{"ES", Unit::volt}}, Eigen::MatrixXd(x));
  const EmgStages stages = clean_emg(raw, {.remove_ecg = true});
  ASSERT_EQ(stages.ecg.size(), 1U);
  EXPECT_EQ(stages.ecg[0].channel, "ES");
  EXPECT_LT(rms(stages.raw.values().col(0)), 0.6 * rms(x));
  EXPECT_TRUE(clean_emg(raw).ecg.empty());
  int named = 0;
  for (const Remark& remark : check_emg(raw)) named += remark.says.find("heart") != std::string::npos;
  EXPECT_EQ(named, 1);
}

}  // namespace
}  // namespace myoid::recording
