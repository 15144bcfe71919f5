#include "myoid/ground/files/analog_channels.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground {
namespace {

AnalogCounts three_counts() {
  AnalogCounts counts;
  AnalogCounts::Columns<std::int16_t> values(3, 2);
  values << 10, -32768, 20, 0, 30, 32767;
  counts.values = values;
  counts.scales = {{.offset = 10.0, .scale = 0.5, .to_si = 1e-3}, {}};
  counts.first_sample = 4.0;
  counts.rate_hz = 2.0;
  return counts;
}

TEST(AnalogChannels, CountsBecomeSamplesInSiOnTheirClock) {
  const AnalogChannels channels({{"E", Unit::volt}, {"C", Unit::dimensionless}}, three_counts());
  EXPECT_EQ(channels.sample_count(), 3);
  const TimeSeries all = channels.series();
  EXPECT_EQ(all.time_s(), Eigen::Vector3d(2.0, 2.5, 3.0));
  // (20 - 10) / 2 mV and (30 - 10) / 2 mV.
  EXPECT_EQ(all.values().col(0), Eigen::Vector3d(0.0, 10.0 * 0.5 * 1e-3, 20.0 * 0.5 * 1e-3));
  EXPECT_EQ(all.values().col(1), Eigen::Vector3d(-32768.0, 0.0, 32767.0));
  EXPECT_EQ(channels.select({"C"}).values(), all.values().col(1));
  EXPECT_EQ(channels.as_written({0}), Eigen::Vector3d(0.0, 5.0, 10.0));
  EXPECT_EQ(channels.find("C"), 1);
  EXPECT_FALSE(channels.find("X"));
  EXPECT_THROW(static_cast<void>(channels.select({"X"})), InvalidInput);
}

TEST(AnalogChannels, DoublesStayAsTheyAre) {
  const TimeSeries series(Eigen::Vector2d(0.0, 1.0), {{"E", Unit::volt}}, Eigen::Vector2d(3.0, 4.0));
  const AnalogChannels channels(series);
  EXPECT_FALSE(channels.empty());
  EXPECT_EQ(channels.series().values(), series.values());
  EXPECT_EQ(channels.select({"E"}).values(), series.values());
  EXPECT_EQ(channels.as_written({0}), series.values());
  EXPECT_TRUE(AnalogChannels().empty());
}

TEST(AnalogChannels, ColumnsWithoutANameOrTwiceAreRefused) {
  EXPECT_THROW(AnalogChannels({{"E", Unit::volt}}, three_counts()), InvalidInput);
  EXPECT_THROW(AnalogChannels({{"E", Unit::volt}, {"E", Unit::volt}}, three_counts()), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground
