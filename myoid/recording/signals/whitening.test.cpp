#include "myoid/recording/signals/whitening.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/recording/signals/emg_envelope.h"

namespace myoid::recording {
namespace {

constexpr double kWhitenedRate_hz = 1000.0;

TimeSeries volts(const Eigen::MatrixXd& x, double rate_hz = kWhitenedRate_hz) {
  std::vector<Channel> channels;
  for (Eigen::Index c = 0; c < x.cols(); ++c) channels.push_back({"m" + std::to_string(c + 1), Unit::volt});
  return {Eigen::VectorXd::LinSpaced(x.rows(), 0.0, static_cast<double>(x.rows() - 1) / rate_hz), channels, x};
}

/// y_k = 1.2 y_{k-1} - 0.5 y_{k-2} + n_k: a spectrum with a hump, of unit variance.
Eigen::VectorXd colored(Eigen::Index n, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd y(n);
  double y1 = 0.0, y2 = 0.0;
  for (Eigen::Index k = -200; k < n; ++k) {
    const double v = 1.2 * y1 - 0.5 * y2 + normal(engine);
    y2 = y1;
    y1 = v;
    if (k >= 0) y[k] = v;
  }
  // Variance of the recursion (Yule & Walker): (1 + 0.5) / ((1 - 0.5) ((1 + 0.5)^2 - 1.2^2)).
  return y / std::sqrt(1.5 / (0.5 * (1.5 * 1.5 - 1.2 * 1.2)));
}

Eigen::VectorXd white(Eigen::Index n, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd y(n);
  for (double& v : y) v = normal(engine);
  return y;
}

/// 10 s of rest and 50 s of effort, in noise of the amplifier.
Eigen::VectorXd effort(double strength, double noise, unsigned seed) {
  Eigen::VectorXd y = strength * colored(60000, seed);
  y.head(10000).setZero();
  return 1e-4 * (y + noise * white(60000, seed + 1000));
}

double relative_spread(const Eigen::VectorXd& envelope) {
  const Eigen::VectorXd e = envelope.segment(12000, 46000);
  return std::sqrt((e.array() - e.mean()).square().mean()) / e.mean();
}

TEST(Whitening, HasTheGainOfTheInverseSpectrumWhereTheMuscleStandsOut) {
  const TimeSeries x = volts(effort(1.0, 0.002, 1));
  const TimeSeries* one = &x;
  const WhiteningFilter f = design_whitening(std::span(&one, 1), 10.0).front();
  ASSERT_TRUE(f.reason.empty()) << f.reason;
  const auto gain = [&](double hz) {
    double sum = f.half[0];
    for (Eigen::Index m = 1; m < f.half.size(); ++m)
      sum += 2.0 * f.half[m] * std::cos(2.0 * kPi * hz * static_cast<double>(m) / kWhitenedRate_hz);
    return std::abs(sum);
  };
  // |1 - 1.2 z^-1 + 0.5 z^-2| undoes the recursion.
  const auto inverse = [](double hz) {
    const double w = 2.0 * kPi * hz / kWhitenedRate_hz;
    return std::hypot(1.0 - 1.2 * std::cos(w) + 0.5 * std::cos(2.0 * w), 1.2 * std::sin(w) - 0.5 * std::sin(2.0 * w));
  };
  // The spectrum of 200 segments over five bins is good to 4 %, its root to 2 %, a ratio of two to
  // 3 %; at the bottom the filter's length (33 ms) rounds it off.
  for (const double hz : {130.0, 180.0, 320.0, 400.0})
    EXPECT_NEAR(gain(hz) / gain(250.0), inverse(hz) / inverse(250.0), 0.08 * inverse(hz) / inverse(250.0)) << hz;
}

TEST(Whitening, TheEnvelopeSpreadsByTheRootOfTheBandwidthLess) {
  const TimeSeries x = volts(effort(1.0, 0.01, 2));
  const EmgStages plain = process_emg(x, {.whitening = false});
  const EmgStages even = process_emg(x);
  const TimeSeries* one = &x;
  const WhiteningFilter f = design_whitening(std::span(&one, 1), 20.0).front();
  // Of the recursion: B = (integral S)^2 / integral S^2 = 196 Hz by its autocovariance; a level
  // spectrum has 500 Hz, less what lies below the high-pass.
  EXPECT_NEAR(f.bandwidth_before_hz, 196.0, 20.0);
  EXPECT_GT(f.bandwidth_after_hz, 420.0);
  // 46 s at 12 independent values a second: each spread is good to 3 %.
  EXPECT_NEAR(relative_spread(even.envelope.values().col(0)) / relative_spread(plain.envelope.values().col(0)),
              std::sqrt(f.bandwidth_before_hz / f.bandwidth_after_hz), 0.08);
  // In volts as before.
  EXPECT_NEAR(even.envelope.values().mean() / plain.envelope.values().mean(), 1.0, 0.02);
}

TEST(Whitening, DoesNotRaiseNoiseAboveTheMuscle) {
  // Ten times fainter than the noise above 250 Hz: a filter that ignores the noise would pass it there.
  const TimeSeries x = volts(effort(1.0, 0.7, 3));
  const TimeSeries* one = &x;
  const WhiteningFilter f = design_whitening(std::span(&one, 1), 20.0).front();
  const EmgStages plain = process_emg(x, {.whitening = false});
  const EmgStages even = process_emg(x);
  const auto ratio = [](const EmgStages& s) {
    const Eigen::VectorXd e = s.envelope.values().col(0);
    return e.head(9000).mean() / e.segment(12000, 46000).mean();
  };
  EXPECT_LT(ratio(even), 1.1 * ratio(plain));
  EXPECT_GE(f.bandwidth_after_hz, f.bandwidth_before_hz);
}

TEST(Whitening, AnEffortOfATenthReadsATenth) {
  // The maximal effort in one trial, a tenth of it in the other, both with the amplifier's noise of
  // 1.5 % of the maximum, and 50 Hz, which the notch takes out.
  Eigen::VectorXd low = effort(0.1, 0.015, 4), high = effort(1.0, 0.015, 5);
  for (Eigen::Index k = 0; k < low.size(); ++k)
    low[k] += 3e-6 * std::sin(2.0 * kPi * 50.0 * static_cast<double>(k) / kWhitenedRate_hz);
  const TimeSeries a = volts(low), b = volts(high);
  const TimeSeries* both[] = {&a, &b};
  const std::vector<EmgStages> stages = process_emg(both);
  const std::vector<TrialEnvelope> trials{{"a", false, &stages[0].envelope}, {"b", true, &stages[1].envelope}};
  const auto n = find_normalisation(trials, {.window_s = 20.0});
  const Eigen::VectorXd activation = normalise(stages[0].envelope, n).values().col(0);
  // 46 s: 1 %, and a bias by the root of a noisy square of half a percent.
  EXPECT_NEAR(activation.segment(12000, 46000).mean(), 0.1, 0.003);
}

TEST(Whitening, LeavesAloneWhatIsWhite) {
  Eigen::VectorXd flat = white(60000, 6);
  flat.head(10000) *= 0.01;
  const TimeSeries level = volts(1e-4 * flat);
  const TimeSeries* one = &level;
  const Whitening decision = decide_whitening(std::span(&one, 1), 20.0);
  EXPECT_FALSE(decision.applied);
  EXPECT_NE(decision.reason.find("not worth it"), std::string::npos) << decision.reason;
  EXPECT_EQ((whiten(level, decision).values() - level.values()).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_TRUE(decide_whitening(std::span(&one, 1), 20.0, true).applied);
}

TEST(Whitening, AnEffortThatNeverRestsHasTheInverseSpectrumToo) {
  // Amplifier noise of 5 % is white, as the filter takes it; the recursion's spectrum at 400 Hz is
  // 1/13 of that at 100 Hz.
  const TimeSeries x = volts(1e-4 * (colored(60000, 7) + 0.05 * white(60000, 70)));
  const TimeSeries* one = &x;
  const WhiteningFilter f = design_whitening(std::span(&one, 1), 20.0).front();
  ASSERT_TRUE(f.reason.empty()) << f.reason;
  // Smoothed over 20 Hz the hump is lower, and part of the tail counts as noise.
  EXPECT_NEAR(f.bandwidth_before_hz, 196.0, 30.0);
  EXPECT_GT(f.bandwidth_after_hz, 380.0);
}

TEST(Whitening, IsOneAnswerForAllChannels) {
  // The second channel is active for only 3 s, which gives no spectrum. Neither channel is whitened.
  Eigen::MatrixXd both(60000, 2);
  both.col(0) = effort(1.0, 0.01, 11);
  both.col(1) = effort(1.0, 0.01, 12);
  both.col(1).tail(47000) *= 0.01;
  const TimeSeries x = volts(both);
  const TimeSeries* one = &x;
  const Whitening decision = decide_whitening(std::span(&one, 1), 20.0);
  EXPECT_FALSE(decision.applied);
  EXPECT_NE(decision.reason.find("m2"), std::string::npos) << decision.reason;
  EXPECT_EQ((whiten(x, decision).values() - x.values()).cwiseAbs().maxCoeff(), 0.0);
  // On request, whitening is refused with the channel's name, not done for one channel.
  EXPECT_THROW((void)decide_whitening(std::span(&one, 1), 20.0, true), InvalidInput);
  // Without a request, nothing is designed.
  EXPECT_TRUE(decide_whitening(std::span(&one, 1), 20.0, false).filters.empty());
  // Both are strong: each is whitened by its own filter.
  both.col(1) = effort(0.5, 0.01, 12);
  const TimeSeries strong = volts(both);
  one = &strong;
  const Whitening yes = decide_whitening(std::span(&one, 1), 20.0);
  EXPECT_TRUE(yes.applied);
  const TimeSeries even = whiten(strong, yes);
  for (const Eigen::Index c : {0, 1}) EXPECT_GT((even.values() - strong.values()).col(c).cwiseAbs().maxCoeff(), 0.0);
}

// A switch at a spare input gives no spectrum; the muscle beside it is whitened nevertheless.
TEST(Whitening, IsNotForASpareInputToRefuse) {
  Eigen::MatrixXd both(60000, 2);
  both.col(0) = effort(1.0, 0.01, 11);
  both.col(1) = effort(1.0, 0.01, 12);
  both.col(1).tail(47000) *= 0.01;
  const auto decide = [&](const char* second) {
    const TimeSeries alike = volts(both);
    const TimeSeries x(alike.time_s(), {{"EMG 1", Unit::volt}, {second, Unit::volt}}, both);
    const TimeSeries* one = &x;
    return decide_whitening(std::span(&one, 1), 20.0);
  };
  EXPECT_FALSE(decide("EMG 2").applied);
  const Whitening beside = decide("Analog 13");
  EXPECT_TRUE(beside.applied) << beside.reason;
  EXPECT_NE(beside.reason.find("of the channel would"), std::string::npos) << beside.reason;
}

TEST(Whitening, ShortSlowAndSilentRecordingsStayAsTheyAre) {
  for (const TimeSeries& x : {volts(effort(1.0, 0.01, 8).head(30)), volts(effort(1.0, 0.01, 8), 200.0),
                              volts(Eigen::VectorXd::Zero(20000))}) {
    const TimeSeries* one = &x;
    const auto filters = design_whitening(std::span(&one, 1), 20.0);
    EXPECT_FALSE(filters.front().reason.empty());
    EXPECT_EQ(filters.front().half.size(), 0);
  }
  EXPECT_TRUE(design_whitening({}, 20.0).empty());
}

TEST(Whitening, DelaysNothing) {
  const TimeSeries x = volts(effort(1.0, 0.01, 9));
  const TimeSeries* one = &x;
  const Whitening filters = decide_whitening(std::span(&one, 1), 20.0);
  ASSERT_TRUE(filters.applied);
  Eigen::VectorXd pulse = Eigen::VectorXd::Zero(1001);
  pulse[500] = 1.0;
  const Eigen::VectorXd y = whiten(volts(pulse), filters).values().col(0);
  EXPECT_LT((y - y.reverse()).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_GT(y.cwiseAbs().maxCoeff(), 0.1);
}

TEST(Whitening, EveryTrialMustHaveTheChannelsOfTheFirst) {
  const TimeSeries a = volts(Eigen::MatrixXd::Zero(60000, 2));
  const TimeSeries b = volts(effort(1.0, 0.01, 10));
  const TimeSeries* both[] = {&a, &b};
  EXPECT_THROW((void)design_whitening(both, 20.0), InvalidInput);
}

}  // namespace
}  // namespace myoid::recording
