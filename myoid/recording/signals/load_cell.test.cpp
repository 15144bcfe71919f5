#include "myoid/recording/signals/load_cell.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::recording {
namespace {

LoadCell cell() {
  LoadCell c;
  c.channels = {"v1", "v2", "v3", "v4", "v5", "v6"};
  c.calibration.setZero();
  for (int i = 0; i < 6; ++i) c.calibration(i, (i + 1) % 6) = 10.0 * (i + 1);  // row i from v(i+2)
  return c;
}

/// 2 s at 100 Hz: offset 0.1 (i + 1), after 1 s a volt more on the fourth channel.
TimeSeries recorded() {
  Eigen::MatrixXd v(200, 6);
  for (Eigen::Index i = 0; i < 200; ++i) {
    for (Eigen::Index c = 0; c < 6; ++c) v(i, c) = 0.1 * static_cast<double>(c + 1) + (c == 3 && i > 100 ? 1.0 : 0.0);
  }
  v(5, 0) = 50.0;  // a spark at rest moves no median
  std::vector<Channel> channels;
  for (const char* name : {"v1", "v2", "v3", "v4", "v5", "v6"}) channels.push_back({name, Unit::volt});
  return {Eigen::VectorXd::LinSpaced(200, 0.0, 1.99), channels, v};
}

TEST(LoadCellWrench, IsTheMatrixTimesTheVoltageAboveTheMedianAtRest) {
  const TimeSeries wrench = load_cell_wrench(recorded(), cell());
  EXPECT_EQ(wrench.channels()[2], (Channel{"Fz", Unit::newton}));
  EXPECT_EQ(wrench.channels()[5], (Channel{"Mz", Unit::newton_meter}));
  EXPECT_NEAR(wrench.column("Fz")[150], 30.0, 1e-12);  // row 3 is 30 N/V of v4
  EXPECT_NEAR(wrench.column("Fz")[50], 0.0, 1e-12);
  EXPECT_NEAR(wrench.column("Fx")[150], 0.0, 1e-12);
  LoadCell opposite = cell();
  opposite.sign = -1.0;
  EXPECT_NEAR(load_cell_wrench(recorded(), opposite).column("Fz")[150], -30.0, 1e-12);
}

TEST(LoadCellWrench, OfAnEvenNumberOfSamplesTheZeroIsTheMeanOfTheMiddleTwo) {
  LoadCell c = cell();
  c.zero_start_s = 0.955;
  c.zero_end_s = 1.055;  // five samples before the step, five after: half a volt
  EXPECT_NEAR(load_cell_wrench(recorded(), c).column("Fz")[150], 15.0, 1e-12);
}

TEST(LoadCellWrench, RefusesWhatCannotBeAForce) {
  LoadCell c = cell();
  c.channels[2] = "v9";
  EXPECT_THROW(static_cast<void>(load_cell_wrench(recorded(), c)), InvalidInput);
  c = cell();
  c.channels.pop_back();
  EXPECT_THROW(static_cast<void>(load_cell_wrench(recorded(), c)), InvalidInput);
  c = cell();
  c.zero_start_s = 5.0;
  c.zero_end_s = 6.0;
  EXPECT_THROW(static_cast<void>(load_cell_wrench(recorded(), c)), InvalidInput);
  c = cell();
  c.calibration(0, 0) = std::nan("");
  EXPECT_THROW(static_cast<void>(load_cell_wrench(recorded(), c)), InvalidInput);
}

}  // namespace
}  // namespace myoid::recording
