#include "myoid/recording/signals/clock_gaps.h"

#include <vector>

#include <gtest/gtest.h>

namespace myoid::recording {
namespace {

/// 100 Hz for 10 s, without the samples strictly between these times.
Eigen::VectorXd clock_without(double begin_s, double end_s) {
  std::vector<double> times;
  for (int i = 0; i <= 1000; ++i) {
    const double t = 0.01 * i;
    if (t <= begin_s + 1e-9 || t >= end_s - 1e-9) times.push_back(t);
  }
  return Eigen::Map<Eigen::VectorXd>(times.data(), static_cast<Eigen::Index>(times.size()));
}

TEST(ClockGaps, AnEvenClockHasNone) {
  EXPECT_EQ(find_clock_gaps(clock_without(0.0, 0.0)).count, 0);
  EXPECT_EQ(find_clock_gaps(Eigen::Vector2d(0.0, 9.0)).count, 0);
}

TEST(ClockGaps, AHoleIsFoundWithItsEnds) {
  const ClockGaps gaps = find_clock_gaps(clock_without(3.0, 6.0));
  EXPECT_EQ(gaps.count, 1);
  EXPECT_NEAR(gaps.longest_begin_s, 3.0, 1e-9);
  EXPECT_NEAR(gaps.longest_s(), 3.0, 1e-9);
  EXPECT_EQ(gaps.text(), "a gap from 3 to 6 s");
}

TEST(ClockGaps, OfATimeSince1970IsNamedToTheMillisecond) {
  const Eigen::VectorXd t = clock_without(3.0, 6.0).array() + 1667324514.0;
  const std::string text = find_clock_gaps(t.array() + 0.25).text();
  for (const char* end : {"1667324517.25", "1667324520.25"}) EXPECT_NE(text.find(end), std::string::npos) << text;
}

TEST(ClockGaps, OneLostSampleIsNoGapAndTwoAre) {
  EXPECT_EQ(find_clock_gaps(clock_without(3.0, 3.02)).count, 0);
  EXPECT_EQ(find_clock_gaps(clock_without(3.0, 3.03)).count, 1);
}

TEST(ClockGaps, OfSeveralTheLongestIsNamed) {
  Eigen::VectorXd t = clock_without(3.0, 6.0);
  t.tail(100).array() += 0.5;
  const ClockGaps gaps = find_clock_gaps(t);
  EXPECT_EQ(gaps.count, 2);
  EXPECT_NEAR(gaps.total_s, 3.51, 1e-9);
  EXPECT_NEAR(gaps.longest_end_s, 6.0, 1e-9);
}

TEST(ClockGaps, WhatLiesBetweenLongPausesAreStretches) {
  const auto stretches = clock_stretches(clock_without(3.0, 6.0), 0.5);
  ASSERT_EQ(stretches.size(), 2U);
  EXPECT_NEAR(stretches[0].begin_s, 0.0, 1e-9);
  EXPECT_NEAR(stretches[0].end_s, 3.0, 1e-9);
  EXPECT_NEAR(stretches[1].begin_s, 6.0, 1e-9);
  EXPECT_NEAR(stretches[1].end_s, 10.0, 1e-9);
  EXPECT_EQ(clock_stretches(clock_without(3.0, 3.4), 0.5).size(), 1U);
}

}  // namespace
}  // namespace myoid::recording
