#include "myoid/fit/measurement/unseen_activations.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::fit {
namespace {

constexpr Eigen::Index kSamples = 1000;
constexpr double kInterval_s = 0.01;

/// Two signals that are never both at rest, n x 2.
Eigen::MatrixXd two_signals() {
  Eigen::MatrixXd h(kSamples, 2);
  for (Eigen::Index i = 0; i < kSamples; ++i) {
    const double phase = 2.0 * std::numbers::pi * static_cast<double>(i) * kInterval_s;
    h(i, 0) = std::max(0.0, std::sin(phase));
    h(i, 1) = std::max(0.0, -std::sin(phase));
  }
  return h;
}

Eigen::MatrixXd four_channels() {
  Eigen::MatrixXd w(4, 2);
  w << 1.0, 0.0, 0.4, 0.6, 0.0, 0.8, 0.7, 0.1;
  return two_signals() * w.transpose();
}

StudyData study_of(const Eigen::MatrixXd& envelopes) {
  StudyData data;
  std::vector<Channel> channels;
  for (Eigen::Index c = 0; c < envelopes.cols(); ++c) {
    channels.push_back({std::string(1, static_cast<char>('a' + c)), Unit::dimensionless});
    data.muscles.push_back({.name = channels.back().name, .emg_channel = channels.back().name, .start = {}});
  }
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(kSamples, 0.0, kInterval_s * (kSamples - 1));
  TrialData trial;
  trial.activation = TimeSeries(time, channels, envelopes);
  data.trials = {trial};
  return data;
}

TEST(Synergies, AreAsManyAsMadeTheEnvelopesAndExplainThem) {
  const Eigen::MatrixXd x = four_channels(), w = synergies_of(x, 0.01);
  ASSERT_EQ(w.cols(), 2);
  EXPECT_GE(w.minCoeff(), 0.0);
  const Eigen::MatrixXd h = activations_of(w, x);
  EXPECT_GE(h.minCoeff(), 0.0);
  EXPECT_LT((x - h * w.transpose()).squaredNorm(), 0.01 * x.squaredNorm());
}

TEST(Synergies, OfOneSynergyIsOneWhateverItsScale) {
  const Eigen::MatrixXd x = two_signals().col(0) * Eigen::RowVector3d(0.01, 1.0, 0.3);
  EXPECT_EQ(synergies_of(x).cols(), 1);
}

TEST(Bandwidth, IsTheCutOffOfFilteredNoise) {
  // The autocorrelation of noise with equal power up to f is sin(x) / x, x = 2 pi f lag.
  constexpr double kCutoff_hz = 2.0;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  constexpr Eigen::Index kLong = 40000;
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(kLong, 1);
  for (int wave = 0; wave < 200; ++wave) {
    const double f = kCutoff_hz * (wave + 0.5) / 200.0, a = normal(random), b = normal(random);
    for (Eigen::Index i = 0; i < kLong; ++i) {
      const double phase = 2.0 * std::numbers::pi * f * static_cast<double>(i) * kInterval_s;
      x(i, 0) += a * std::cos(phase) + b * std::sin(phase);
    }
  }
  EXPECT_NEAR(bandwidth_hz(x, kInterval_s), kCutoff_hz, 0.1 * kCutoff_hz);
  EXPECT_EQ(bandwidth_hz(Eigen::MatrixXd::Constant(100, 2, 0.3), kInterval_s), 0.25);  // no change, no time
}

TEST(ExpectActivations, LeavesDataWithAllEmgAsTheyAre) {
  StudyData data = study_of(four_channels());
  expect_activations(data);
  EXPECT_EQ(data.trials[0].activation.channel_count(), 4);
}

TEST(ExpectActivations, FillsAConstantAndSynergiesOfTheBelievedMean) {
  StudyData data = study_of(four_channels());
  const Eigen::MatrixXd before = data.trials[0].activation.values();
  data.muscles.push_back({.name = "p", .emg_channel = "p without EMG", .start = {}});
  data.muscles.back().unseen = UnseenActivation{.by = WithoutEmg::unseen, .parts = {}};
  data.muscles.push_back({.name = "q", .emg_channel = "q without EMG", .start = {}});
  data.muscles.back().unseen = UnseenActivation{.by = WithoutEmg::synergies, .parts = {}};
  expect_activations(data);
  const TimeSeries& a = data.trials[0].activation;
  EXPECT_EQ(a.values().leftCols(4), before);
  EXPECT_TRUE((a.column("p without EMG").array() == beliefs::kUnseenActivation.value).all());
  EXPECT_NEAR(a.column("q without EMG").mean(), beliefs::kUnseenActivation.value, 1e-6);
  ASSERT_EQ(data.muscles[5].unseen->parts.size(), 2u);
  EXPECT_NEAR((a.select(data.muscles[5].unseen->parts).values().rowwise().sum() - a.column("q without EMG")).norm(),
              0.0, 1e-12);
  EXPECT_GT(data.muscles[4].unseen->sd, data.muscles[5].unseen->sd);
}

TEST(ExpectActivations, OfAnotherStudysTrialsAreTheSynergiesOfTheFit) {
  StudyData data = study_of(four_channels());
  data.muscles.push_back({.name = "q", .emg_channel = "q without EMG", .start = {}});
  data.muscles.back().unseen = UnseenActivation{.by = WithoutEmg::synergies, .parts = {}};
  StudyData other = data;
  other.trials[0].activation = study_of(0.5 * four_channels().rowwise().reverse()).trials[0].activation;
  expect_activations(data);
  expect_activations(other);
  std::vector<TrialData> trials = other.trials;
  expect_activations_of(data, trials);
  EXPECT_NE(trials[0].activation.column("q without EMG"), other.trials[0].activation.column("q without EMG"));
  // The trial of the fit itself is as the fit has it.
  trials = data.trials;
  expect_activations_of(data, trials);
  EXPECT_EQ(trials[0].activation.column("q without EMG"), data.trials[0].activation.column("q without EMG"));
}

TEST(ExpectActivations, RefusesAStudyWithoutAnyEmg) {
  StudyData data = study_of(four_channels());
  for (MuscleSetup& muscle : data.muscles) muscle.unseen = UnseenActivation{.by = WithoutEmg::unseen, .parts = {}};
  EXPECT_THROW(expect_activations(data), InvalidInput);
}

}  // namespace
}  // namespace myoid::fit
