#include "myoid/ground/core/clock_facts.h"

#include <limits>

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

TEST(ClockFacts, WithoutSamplesThereIsNeitherStartNorDurationNorRate) {
  const ClockFacts none = clock_facts(Eigen::VectorXd());
  EXPECT_EQ(none.samples, 0);
  EXPECT_FALSE(none.start_s || none.duration_s || none.rate_hz || none.even);
}

TEST(ClockFacts, OneSampleHasATimeButNoRate) {
  const ClockFacts one = clock_facts(Eigen::VectorXd::Constant(1, 2.5));
  EXPECT_EQ(one.start_s, 2.5);
  EXPECT_EQ(one.duration_s, 0.0);
  EXPECT_FALSE(one.rate_hz || one.even);
}

TEST(ClockFacts, AnEvenClockHasTheRateOfItsIntervals) {
  // Quarters are exact in binary.
  const ClockFacts facts = clock_facts(Eigen::Vector3d(1.0, 1.25, 1.5));
  EXPECT_EQ(facts.duration_s, 0.5);
  EXPECT_EQ(facts.rate_hz, 4.0);
  EXPECT_TRUE(facts.even);
  EXPECT_FALSE(clock_facts(Eigen::Vector3d(1.0, 1.2, 1.5)).even);
}

TEST(ClockFacts, TimesThatAreNoNumbersLeaveOutWhatCannotBeComputed) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(clock_facts(Eigen::Vector2d(kNone, 1.0)).start_s);
  const ClockFacts open = clock_facts(Eigen::Vector2d(0.0, kNone));
  EXPECT_EQ(open.start_s, 0.0);
  EXPECT_FALSE(open.duration_s || open.rate_hz || open.even);
  EXPECT_FALSE(clock_facts(Eigen::Vector3d(0.0, kNone, 1.0)).even);
  EXPECT_FALSE(clock_facts(Eigen::Vector2d(1.0, 1.0)).rate_hz);
}

}  // namespace
}  // namespace myoid::inline ground
