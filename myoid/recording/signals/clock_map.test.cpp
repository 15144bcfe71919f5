#include "myoid/recording/signals/clock_map.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::recording {
namespace {

TEST(ClockMap, ShiftsByTheOffsetAtThePivotAndByTheDriftBeyond) {
  const ClockMap clock{.offset_s = 0.5, .drift_ppm = 100.0, .pivot_s = 10.0};
  EXPECT_DOUBLE_EQ(clock.study_time_s(10.0), 10.5);
  EXPECT_DOUBLE_EQ(clock.study_time_s(20.0), 20.501);
  EXPECT_DOUBLE_EQ(clock.study_time_s(0.0), 0.499);
}

TEST(ClockMap, GoesBack) {
  const ClockMap clock{.offset_s = -0.25, .drift_ppm = -3000.0, .pivot_s = 4.0};
  for (const double t : {-3.0, 0.0, 17.5}) EXPECT_NEAR(clock.file_time_s(clock.study_time_s(t)), t, 1e-14 * 20.0);
}

TEST(ClockMap, OnTheStudysClockNoSampleChanges) {
  Eigen::VectorXd t(3);
  t << 0.0, 1.0, 2.0;
  const TimeSeries x(t, {{"a", Unit::volt}}, Eigen::Vector3d(4.0, 5.0, 6.0));
  const TimeSeries y = on_study_clock(x, {.offset_s = 0.125});
  EXPECT_EQ(y.values(), x.values());
  EXPECT_EQ(y.time_s(), Eigen::Vector3d(0.125, 1.125, 2.125));
  EXPECT_THROW((void)on_study_clock(x, {.drift_ppm = 3e5}), InvalidInput);
}

TEST(ClockMap, IsToldWithItsUncertainty) {
  EXPECT_EQ(to_string(ClockMap{.offset_s = 0.0123}), "+12.3 ms");
  EXPECT_EQ(to_string(ClockMap{.offset_s = -0.0123, .drift_ppm = 48.2, .offset_sd_s = 0.0006, .drift_sd_ppm = 3.0}),
            "-12.3 ± 0.6 ms, 48 ± 3 ppm");
  EXPECT_EQ(to_string(ClockMap{.offset_s = -0.1438, .offset_sd_s = 0.2994}), "-143.8 ± 299 ms");
}

}  // namespace
}  // namespace myoid::recording
