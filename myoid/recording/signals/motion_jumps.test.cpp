#include "myoid/recording/signals/motion_jumps.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"

namespace myoid::recording {
namespace {

/// An angle that swings by 50 degrees at 0.5 Hz for 10 s, plus what `more` adds at each time.
template <typename More>
TimeSeries swing(More more, Unit unit = Unit::radian) {
  constexpr double kRate_hz = 100.0;
  Eigen::VectorXd t(1001), q(1001);
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    t[i] = static_cast<double>(i) / kRate_hz;
    q[i] = 50.0 * kDegree * std::sin(kPi * t[i]) + more(t[i]);
  }
  return {t, {{"elbow", unit}}, q};
}

TEST(MotionJumps, ASampleThatIsOffIsNamedWithItsTimeAndSpeed) {
  const auto jumps = find_motion_jumps(swing([](double t) { return std::abs(t - 4.0) < 1e-6 ? 8.0 * kDegree : 0.0; }));
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_EQ(jumps[0].channel, "elbow");
  EXPECT_EQ(jumps[0].count, 1);
  EXPECT_NEAR(jumps[0].time_s, 3.995, 0.006);
  // 8 degrees in 10 ms, and the swing's own 157 deg/s at most.
  EXPECT_NEAR(jumps[0].speed / kDegree, 800.0 + 157.0, 2.0);
}

TEST(MotionJumps, AStepAndAGlitchThatWasSmoothedAreOnesToo) {
  EXPECT_EQ(find_motion_jumps(swing([](double t) { return t > 6.0 ? 10.0 * kDegree : 0.0; })).size(), 1U);
  EXPECT_EQ(find_motion_jumps(swing([](double t) {
              return 40.0 * kDegree * std::exp(-0.5 * std::pow((t - 5.0) / 0.02, 2));
            })).size(),
            1U);
}

TEST(MotionJumps, OnlyThoseOfTheStretchAreTold) {
  const TimeSeries motion = swing([](double t) {
    return std::abs(t - 4.0) < 1e-6 ? 8.0 * kDegree : std::abs(t - 8.0) < 1e-6 ? 12.0 * kDegree : 0.0;
  });
  EXPECT_NEAR(find_motion_jumps(motion).at(0).time_s, 7.995, 0.006);
  EXPECT_TRUE(find_motion_jumps(motion, {5.0, 7.0}).empty());
  const auto earlier = find_motion_jumps(motion, {3.5, 4.5});
  ASSERT_EQ(earlier.size(), 1U);
  EXPECT_NEAR(earlier[0].time_s, 3.995, 0.006);
  EXPECT_EQ(earlier[0].count, 1);
}

TEST(MotionJumps, FastMovementsAreNone) {
  // A single reach of 90 degrees within 0.3 s, with the bell of a minimum jerk: 560 deg/s.
  const auto reach = [](double t) {
    const double s = std::clamp((t - 5.0) / 0.3, 0.0, 1.0);
    return 90.0 * kDegree * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
  };
  EXPECT_TRUE(find_motion_jumps(swing(reach)).empty());
  // A channel other than angles and lengths.
  EXPECT_TRUE(find_motion_jumps(swing([](double t) { return t > 6.0 ? 10.0 : 0.0; }, Unit::newton)).empty());
}

}  // namespace
}  // namespace myoid::recording
