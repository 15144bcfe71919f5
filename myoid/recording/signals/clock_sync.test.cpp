#include "myoid/recording/signals/clock_sync.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::recording {
namespace {

/// A channel of pulses of 20 ms that begin at these times on the clock of the study, as an
/// instrument with this clock and rate records it.
TimeSeries pulses(
    const std::vector<double>& study_s, const ClockMap& clock, double rate_hz, double first_s, double last_s) {
  const auto n = static_cast<Eigen::Index>((last_s - first_s) * rate_hz) + 1;
  Eigen::VectorXd t(n), x = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    t[i] = first_s + static_cast<double>(i) / rate_hz;
    for (const double s : study_s) {
      const double since = clock.study_time_s(t[i]) - s;
      if (since >= 0.0 && since < 0.02) x[i] = 5.0;
    }
  }
  return {t, {{"sync", Unit::volt}}, x};
}

/// Movement that does not repeat itself: sines of many frequencies.
double wander(double t, unsigned seed) {
  std::mt19937_64 engine(seed);
  double x = 0.0;
  for (int k = 0; k < 25; ++k) {
    const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
    const double f = 0.1 + 6.0 * uniform();
    const double phase = 2.0 * kPi * uniform();
    x += std::sin(2.0 * kPi * f * t + phase) / (0.5 + f);
  }
  return x;
}

TimeSeries wandering(const ClockMap& clock, double rate_hz, double first_s, double last_s) {
  const auto n = static_cast<Eigen::Index>((last_s - first_s) * rate_hz) + 1;
  Eigen::VectorXd t(n), x(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    t[i] = first_s + static_cast<double>(i) / rate_hz;
    x[i] = wander(clock.study_time_s(t[i]), 5);
  }
  return {t, {{"x", Unit::volt}}, x};
}

TEST(TriggerEdges, AreFoundBetweenTheSamplesBeforeAndAfter) {
  const TimeSeries x = pulses({1.0003, 2.5}, {}, 1000.0, 0.0, 4.0);
  const Instants edges = trigger_edges(x, "sync");
  ASSERT_EQ(edges.time_s.size(), 2U);
  EXPECT_NEAR(edges.time_s[0], 1.0005, 1e-9);
  EXPECT_NEAR(edges.time_s[1], 2.4995, 1e-9);
  EXPECT_NEAR(edges.sd_s, 0.001 / std::sqrt(12.0), 1e-12);
  ASSERT_EQ(trigger_edges(x, "sync", true).time_s.size(), 2U);
  EXPECT_NEAR(trigger_edges(x, "sync", true).time_s[0], 1.0205, 1e-9);
}

TEST(TriggerEdges, DoNotCountTheNoiseOfAnEdgeTwice) {
  Eigen::VectorXd x(9);
  x << 0.0, 0.1, 2.6, 2.4, 2.7, 5.0, 4.9, 0.0, 0.1;
  const TimeSeries s(Eigen::VectorXd::LinSpaced(9, 0.0, 8.0), {{"t", Unit::volt}}, x);
  EXPECT_EQ(trigger_edges(s, "t").time_s.size(), 1U);
}

TEST(TriggerEdges, OfAChannelThatNeverChangesThereAreNone) {
  const TimeSeries s(Eigen::VectorXd::LinSpaced(9, 0.0, 8.0), {{"t", Unit::volt}}, Eigen::VectorXd::Ones(9));
  EXPECT_TRUE(trigger_edges(s, "t").time_s.empty());
}

TEST(MatchInstants, FindOffsetAndDriftOfTwoClocksWithinTheirStatedErrors) {
  // 50 ppm over 60 s are 3 ms. The file began 1.7 s before the study's recording.
  std::mt19937_64 engine(11);
  int within = 0;
  constexpr int kCases = 40;
  for (int k = 0; k < kCases; ++k) {
    const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
    const ClockMap truth{.offset_s = -1.7 + 0.01 * uniform(), .drift_ppm = 50.0};
    std::vector<double> times;
    for (double t = 1.0 + uniform(); t < 59.0; t += 3.0 + 2.0 * uniform()) times.push_back(t);
    const TimeSeries file = pulses(times, truth, 2000.0, 0.0, 65.0);
    const TimeSeries study = pulses(times, {}, 1000.0, 0.0, 60.0);
    const ClockMap found = match_instants(trigger_edges(file, "sync"), trigger_edges(study, "sync"));
    ASSERT_TRUE(found.offset_sd_s && found.drift_sd_ppm);
    EXPECT_LT(*found.offset_sd_s, 2e-4);
    EXPECT_LT(*found.drift_sd_ppm, 8.0);
    const double offset_error = found.study_time_s(found.pivot_s) - truth.study_time_s(found.pivot_s);
    EXPECT_NEAR(found.drift_ppm, 50.0, 4.0 * *found.drift_sd_ppm);
    EXPECT_LT(std::abs(offset_error), 4.0 * *found.offset_sd_s);
    if (std::abs(offset_error) < 2.0 * *found.offset_sd_s &&
        std::abs(found.drift_ppm - 50.0) < 2.0 * *found.drift_sd_ppm)
      ++within;
  }
  EXPECT_GE(within, 32);  // 0.91 of 40 expected for two normal errors, less three standard errors
}

TEST(MatchInstants, OneEdgeGivesTheOffsetAndLeavesTheDriftToWhatClocksAre) {
  const ClockMap found = match_instants({.time_s = {3.0}, .sd_s = 3e-4}, {.time_s = {1.2}, .sd_s = 4e-4});
  EXPECT_DOUBLE_EQ(found.study_time_s(3.0), 1.2);
  EXPECT_EQ(found.drift_ppm, 0.0);
  EXPECT_NEAR(*found.offset_sd_s, 5e-4, 1e-15);
  EXPECT_NEAR(*found.drift_sd_ppm, kClockPrior_ppm, 1e-9);
}

TEST(MatchInstants, TwoEdgesCloseTogetherDoNotMakeADrift) {
  // 0.3 ms over 1 s would be 300 ppm, or 18 ms a minute later.
  const ClockMap found = match_instants({.time_s = {1.0, 2.0}, .sd_s = 3e-4}, {.time_s = {1.0, 2.0003}, .sd_s = 3e-4});
  EXPECT_LT(std::abs(found.drift_ppm), 20.0);
  EXPECT_GT(*found.drift_sd_ppm, 90.0);
}

TEST(MatchInstants, EdgesThatOneRecordingMissedAreFoundByTheIntervals) {
  const std::vector<double> all{1.0, 2.3, 4.1, 4.9, 7.0, 9.6};
  const std::vector<double> some{2.3 - 0.8, 4.1 - 0.8, 4.9 - 0.8, 7.0 - 0.8};
  const ClockMap found = match_instants({.time_s = some, .sd_s = 1e-4}, {.time_s = all, .sd_s = 1e-4});
  EXPECT_NEAR(found.study_time_s(1.5), 2.3, 1e-9);
  const ClockMap other = match_instants({.time_s = all, .sd_s = 1e-4}, {.time_s = some, .sd_s = 1e-4});
  EXPECT_NEAR(other.study_time_s(2.3), 1.5, 1e-9);
}

TEST(MatchInstants, RefuseWhatCannotBePaired) {
  const Instants even{.time_s = {1.0, 2.0, 3.0, 4.0, 5.0}, .sd_s = 1e-4};
  EXPECT_THROW((void)match_instants({.time_s = {1.0, 2.0, 3.0}, .sd_s = 1e-4}, even), InvalidInput);
  EXPECT_THROW((void)match_instants({.time_s = {1.0, 2.5, 3.1}, .sd_s = 1e-4}, even), InvalidInput);
  EXPECT_THROW((void)match_instants({.time_s = {1.0}, .sd_s = 1e-4}, even), InvalidInput);
  EXPECT_THROW((void)match_instants({}, even), InvalidInput);
  EXPECT_THROW((void)match_instants({.time_s = {1.0, 2.0}, .sd_s = 1e-4}, {.time_s = {1.0, 3.0}, .sd_s = 1e-4}),
               InvalidInput);
}

TEST(MatchShape, FindsOffsetAndDriftOfACommonSignal) {
  for (const double offset : {-0.731, 0.0042, 0.95}) {
    const ClockMap truth{.offset_s = offset, .drift_ppm = 50.0};
    const ClockMap found = match_shape(wandering(truth, 2000.0, 0.0, 60.0), wandering({}, 100.0, 0.0, 60.0), 1.5);
    ASSERT_TRUE(found.offset_sd_s && found.drift_sd_ppm);
    // Both recordings hold the signal exactly: the error is interpolation.
    EXPECT_LT(*found.offset_sd_s, 5e-4);
    EXPECT_NEAR(found.study_time_s(found.pivot_s), truth.study_time_s(found.pivot_s), 4.0 * *found.offset_sd_s)
        << offset;
    EXPECT_NEAR(found.drift_ppm, 50.0, 4.0 * *found.drift_sd_ppm) << offset;
    EXPECT_LT(*found.drift_sd_ppm, 30.0);
  }
}

TEST(MatchShape, RefusesSignalsThatAreNotTheSameOrRepeatThemselves) {
  const TimeSeries x = wandering({}, 500.0, 0.0, 20.0);
  Eigen::VectorXd other(x.sample_count()), sine(x.sample_count());
  for (Eigen::Index i = 0; i < other.size(); ++i) {
    other[i] = wander(x.time_s()[i], 77);
    sine[i] = std::sin(2.0 * kPi * 1.3 * x.time_s()[i]);
  }
  const TimeSeries unlike(x.time_s(), x.channels(), other);
  EXPECT_THROW((void)match_shape(x, unlike, 1.0), InvalidInput);
  const TimeSeries repeating(x.time_s(), x.channels(), sine);
  EXPECT_THROW((void)match_shape(repeating, repeating, 1.0), InvalidInput);
  EXPECT_NEAR(match_shape(repeating, repeating, 0.3).offset_s, 0.0, 1e-3);
  EXPECT_THROW((void)match_shape(x.slice(0.0, 3.0), x, 0.5), InvalidInput);
}

}  // namespace
}  // namespace myoid::recording
