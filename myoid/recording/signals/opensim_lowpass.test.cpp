#include "myoid/recording/signals/opensim_lowpass.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::recording {
namespace {

TimeSeries sine_series(double frequency_hz, double interval_s, Eigen::Index count) {
  Eigen::VectorXd t(count);
  Eigen::MatrixXd x(count, 1);
  for (Eigen::Index i = 0; i < count; ++i) {
    t[i] = interval_s * static_cast<double>(i);
    x(i, 0) = std::sin(2.0 * kPi * frequency_hz * t[i]);
  }
  return {t, {{"q", Unit::radian}}, x};
}

TEST(OpensimLowpass, PassesHalfOfTheAmplitudeAtTheCutoff) {
  const TimeSeries filtered = opensim_lowpass(sine_series(6.0, 0.01, 1001), 6.0);
  // Far from the ends, over whole periods.
  const Eigen::Index middle = filtered.sample_count() / 2;
  const double largest = filtered.values().col(0).segment(middle - 200, 400).cwiseAbs().maxCoeff();
  // The sine of 6 Hz meets a sample at its top within 1e-3.
  EXPECT_NEAR(largest, 0.5, 1e-3);
}

TEST(OpensimLowpass, KeepsALineAndItsAddedEnds) {
  Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(101, 0.0, 1.0);
  const TimeSeries line(t, {{"q", Unit::radian}}, Eigen::MatrixXd(2.0 * t.array() - 1.0));
  const TimeSeries filtered = opensim_lowpass(line, 10.0);
  EXPECT_NEAR(filtered.time_s()[0], -0.5, 1e-12);
  EXPECT_NEAR(filtered.time_s()[filtered.sample_count() - 1], 1.5, 0.011);
  // The filter delays a ramp by a constant in each direction: both passes cancel.
  // Transients of the ends fall as exp(-31 t): to 1e-9 in 0.7 s.
  for (Eigen::Index i = 75; i < filtered.sample_count() - 75; ++i)
    EXPECT_NEAR(filtered.values()(i, 0), 2.0 * filtered.time_s()[i] - 1.0, 1e-8);
}

TEST(OpensimLowpass, SamplesAtTheSmallestInterval) {
  Eigen::VectorXd t(6);
  t << 0.0, 0.0167, 0.0333, 0.05, 0.0667, 0.0833;
  const TimeSeries uneven(t, {{"q", Unit::radian}}, Eigen::MatrixXd(t));
  const TimeSeries filtered = opensim_lowpass(uneven, 6.0);
  EXPECT_NEAR(filtered.time_s()[1] - filtered.time_s()[0], 0.0166, 1e-12);
}

TEST(OpensimLowpass, RefusesWhatItCannotFilter) {
  EXPECT_THROW((void)opensim_lowpass(sine_series(1.0, 0.01, 50), 0.0), InvalidInput);
  EXPECT_THROW((void)opensim_lowpass(sine_series(1.0, 0.01, 3), 6.0), InvalidInput);
  Eigen::VectorXd t(5);
  t << 0.0, 1e-9, 1.0, 2.0, 3.0;
  EXPECT_THROW((void)opensim_lowpass(TimeSeries(t, {{"q", Unit::radian}}, Eigen::MatrixXd(t)), 6.0), InvalidInput);
}

// Rows of a range are chosen by comparing times: the last digit decides whether the first row belongs to it.
TEST(OpensimLowpass, TimesAreTheFilesOrSumsOfTheInterval) {
  // Powers of two have no rounding: nothing is resampled, and the padded times stay.
  Eigen::VectorXd even = Eigen::VectorXd::LinSpaced(33, 0.0, 0.5);
  const TimeSeries kept = opensim_lowpass({even, {{"q", Unit::radian}}, Eigen::MatrixXd(even)}, 6.0);
  ASSERT_EQ(kept.sample_count(), 65);
  for (Eigen::Index i = 0; i < 33; ++i) EXPECT_EQ(kept.time_s()[i + 16], even[i]);
  // Otherwise each time is the sum of the time before and the smallest interval.
  Eigen::VectorXd uneven(7);
  uneven << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7000001;
  const TimeSeries summed = opensim_lowpass({uneven, {{"q", Unit::radian}}, Eigen::MatrixXd(uneven)}, 1.0);
  // Half a record, three rows, is added at each end: 2 x 0.1 - 0.4 is the first time.
  EXPECT_EQ(summed.time_s()[0], 2.0 * 0.1 - 0.4);
  const double interval = summed.time_s()[1] - summed.time_s()[0];
  double t = summed.time_s()[1];
  for (Eigen::Index i = 2; i < summed.sample_count(); ++i) EXPECT_NEAR(summed.time_s()[i], t += interval, 1e-15);
}

}  // namespace
}  // namespace myoid::recording
