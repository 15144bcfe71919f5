#include "myoid/recording/signals/resample.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::recording {
namespace {

TimeSeries tone(double frequency_hz, double rate_hz, double duration_s, double start_s = 0.0) {
  const auto n = static_cast<Eigen::Index>(std::lround(duration_s * rate_hz)) + 1;
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(n, start_s, start_s + duration_s);
  return {t, {{"x", Unit::volt}}, (2.0 * kPi * frequency_hz * t.array()).sin().matrix()};
}

/// Largest value away from the ends, where the odd reflection of a sine is no sine.
double largest_inside(const Eigen::VectorXd& x, Eigen::Index margin) {
  return x.segment(margin, x.size() - 2 * margin).cwiseAbs().maxCoeff();
}

// The margin of 40 samples of the new clock is more than the 32 that the kernel reaches.
class Downsampled : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(Downsampled, ATonePassesBelowFourFifthsOfHalfTheNewRateWithinOneInAHundredThousand) {
  const auto [old_hz, new_hz] = GetParam();
  const Eigen::VectorXd clock = even_clock(0.0, 10.0, new_hz);
  for (const double share : {0.05, 0.3, 0.6, 0.79}) {
    const double f = 0.5 * share * new_hz;
    const TimeSeries y = resample(tone(f, old_hz, 10.0), clock);
    const Eigen::VectorXd truth = (2.0 * kPi * f * clock.array()).sin();
    // Ripple 1e-5 at 100 dB, and the table's straight lines: pi^2 / 8 (1e-3)^2.
    EXPECT_LT(largest_inside(y.values().col(0) - truth, 40), 3e-5) << f << " Hz";
  }
}

TEST_P(Downsampled, AToneAboveHalfTheNewRateIsGoneByNinetyDecibels) {
  const auto [old_hz, new_hz] = GetParam();
  const Eigen::VectorXd clock = even_clock(0.0, 10.0, new_hz);
  for (const double share : {1.01, 1.2, 1.9, 2.0}) {
    const double f = 0.5 * share * new_hz;
    if (f > 0.49 * old_hz) continue;
    const TimeSeries y = resample(tone(f, old_hz, 10.0), clock);
    EXPECT_LT(largest_inside(y.values().col(0), 40), 3.2e-5) << f << " Hz";  // -90 dB
  }
}

INSTANTIATE_TEST_SUITE_P(Rates,
                         Downsampled,
                         ::testing::Values(std::pair(2000.0, 100.0),
                                           std::pair(1000.0, 250.0),
                                           std::pair(2148.1481, 200.0),
                                           std::pair(100.0, 60.0)));

TEST(Resample, WhatASlowerClockCannotHoldDoesNotComeBackAsSomethingElse) {
  // 60 Hz at 1 kHz, every tenth sample: a beat of 40 Hz of full size, were it not filtered.
  const Eigen::VectorXd clock = even_clock(0.0, 5.0, 100.0);
  EXPECT_LT(largest_inside(resample(tone(60.0, 1000.0, 5.0), clock).values().col(0), 40), 1e-4);
}

TEST(Resample, AConstantAndALineStayThemselvesUpToTheEnds) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(1001, 0.0, 1.0);
  Eigen::MatrixXd x(1001, 2);
  x.col(0).setConstant(3.7);
  x.col(1) = 2.0 + 5.0 * t.array();
  const Eigen::VectorXd clock = even_clock(0.0, 1.0, 100.0);
  const TimeSeries y = resample(TimeSeries(t, {{"a", Unit::volt}, {"b", Unit::volt}}, x), clock);
  EXPECT_LT((y.values().col(0).array() - 3.7).abs().maxCoeff(), 1e-12);
  // Symmetric weights about a time on the grid; odd reflection continues a line.
  EXPECT_LT((y.values().col(1).array() - 2.0 - 5.0 * clock.array()).abs().maxCoeff(), 1e-9);
}

TEST(Resample, DoesNotDelay) {
  // A bump far slower than the new rate, sampled between the old samples: its middle stays.
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(2001, 0.0, 2.0);
  const auto bump = [](double s) { return std::exp(-0.5 * std::pow((s - 1.0) / 0.05, 2)); };
  const TimeSeries x(t, {{"x", Unit::volt}}, t.unaryExpr(bump));
  const Eigen::VectorXd clock = Eigen::VectorXd::LinSpaced(140, 0.30025, 0.30025 + 139.0 / 100.0);
  const Eigen::VectorXd y = resample(x, clock).values().col(0);
  // The bump's spectrum at 40 Hz is exp(-2 (pi 40 0.05)^2), nothing.
  EXPECT_LT((y - clock.unaryExpr(bump)).cwiseAbs().maxCoeff(), 3e-5);
}

TEST(Resample, AFasterClockIsASplineWithinATenthOfAPercentUpToATenthOfTheOldRate) {
  const Eigen::VectorXd clock = even_clock(1.0, 9.0, 1000.0);
  for (const double f : {1.0, 5.0, 10.0}) {
    const TimeSeries y = resample(tone(f, 100.0, 10.0), clock);
    const Eigen::VectorXd truth = (2.0 * kPi * f * clock.array()).sin();
    EXPECT_LT(largest_inside(y.values().col(0) - truth, 100), 1e-3) << f;
  }
}

TEST(Resample, RefusesAValueThatIsNoNumber) {
  TimeSeries x = tone(1.0, 1000.0, 1.0);
  Eigen::MatrixXd values = x.values();
  values(500, 0) = std::numeric_limits<double>::quiet_NaN();
  x = TimeSeries(x.time_s(), x.channels(), values);
  EXPECT_THROW((void)resample(x, even_clock(0.0, 1.0, 100.0)), InvalidInput);
  EXPECT_THROW((void)resample(x, even_clock(0.0, 1.0, 1000.0)), InvalidInput);
}

TEST(AntiAliased, KeepsTheClockAndTakesOutWhatTheRateCannotHold) {
  const TimeSeries slow = tone(10.0, 1000.0, 4.0);
  const TimeSeries fast = tone(80.0, 1000.0, 4.0);
  const TimeSeries both(slow.time_s(), slow.channels(), slow.values() + fast.values());
  const TimeSeries y = anti_aliased(both, 100.0);
  EXPECT_EQ(y.time_s(), both.time_s());
  EXPECT_LT(largest_inside(y.values().col(0) - slow.values().col(0), 400), 1e-4);
  EXPECT_EQ(anti_aliased(both, 1000.0).values(), both.values());
}

TEST(ResampledMarkers, FollowEachMarkerAndDoNotCrossItsGaps) {
  MarkerSeries markers;
  markers.names = {"A", "B"};
  markers.time_s = Eigen::VectorXd::LinSpaced(401, 0.0, 4.0);
  markers.positions_m = Eigen::MatrixXd::Zero(401, 6);
  markers.positions_m.col(0) = (2.0 * kPi * markers.time_s.array()).sin();
  markers.positions_m.col(3) = markers.time_s;
  markers.positions_m.block(150, 3, 20, 3).setConstant(std::numeric_limits<double>::quiet_NaN());
  for (const double rate : {50.0, 250.0}) {
    const Eigen::VectorXd clock = even_clock(0.0, 4.0, rate);
    const MarkerSeries y = resample(markers, clock);
    for (Eigen::Index i = 0; i < clock.size(); ++i) {
      ASSERT_FALSE(y.missing(i, 0));
      const bool gap = clock[i] > 1.4951 && clock[i] < 1.6949;
      EXPECT_EQ(y.missing(i, 1), gap) << clock[i];
      // A line stays one; half a frame beyond the last one takes the end value.
      if (!gap) {
        EXPECT_NEAR(y.positions_m(i, 3), clock[i], 0.0051) << clock[i];
      }
    }
    const auto n = clock.size() / 4;
    EXPECT_LT(
        (y.positions_m.col(0) - (2.0 * kPi * clock.array()).sin().matrix()).segment(n, 2 * n).cwiseAbs().maxCoeff(),
        1e-4);
  }
}

TEST(Resample, PassesThroughItsPointsAndKeepsTheEndsBeyond) {
  const TimeSeries x(Eigen::Vector4d(0, 1, 2, 3), {{"a"}}, Eigen::Vector4d(0, 1, 0, 1));
  const TimeSeries y = resample(x, Eigen::VectorXd::LinSpaced(7, -1.0, 5.0));
  EXPECT_NEAR(y.values()(0, 0), 0.0, 1e-15);
  EXPECT_NEAR(y.values()(2, 0), 1.0, 1e-15);
  EXPECT_NEAR(y.values()(6, 0), 1.0, 1e-15);
}

}  // namespace
}  // namespace myoid::recording
