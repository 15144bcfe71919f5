#include "myoid/recording/channel_choice.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/message_of.h"

namespace myoid::recording {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TimeSeries series(std::vector<std::string> names, double rate_hz) {
  std::vector<Channel> channels;
  Eigen::MatrixXd values(3, static_cast<Eigen::Index>(names.size()));
  for (std::size_t c = 0; c < names.size(); ++c) {
    channels.push_back({names[c], Unit::volt});
    values.col(static_cast<Eigen::Index>(c)).setConstant(static_cast<double>(c));
  }
  return {Eigen::Vector3d(0.0, 1.0, 2.0) / rate_hz, std::move(channels), std::move(values)};
}

const std::vector<const AnalogChannels*>& two_clocks() {
  static const AnalogChannels muscles(series({"Biceps Brachii", "Triceps"}, 2000.0));
  static const AnalogChannels accelerations(series({"ACC X"}, 148.0));
  static const std::vector<const AnalogChannels*> clocks{&muscles, &accelerations};
  return clocks;
}

std::string refusal(const std::vector<std::string>& wanted) {
  return test::message_of<ReadError>([&] { static_cast<void>(choose_channels(two_clocks(), wanted, "f.csv")); });
}

TEST(ChannelChoice, WithoutNamesAllChannelsOfTheFirstClock) {
  EXPECT_EQ(choose_channels(two_clocks(), {}, "f.csv").channel_count(), 2);
  EXPECT_TRUE(choose_channels({}, {}, "f.csv").empty());
}

TEST(ChannelChoice, TheNamesAskedForComeInTheirOrderAndOnce) {
  const TimeSeries chosen = choose_channels(two_clocks(), {"Triceps", "biceps_brachii", "TRICEPS"}, "f.csv");
  ASSERT_EQ(chosen.channel_count(), 2);
  EXPECT_EQ(chosen.channels()[0].name, "Triceps");
  EXPECT_EQ(chosen.channels()[1].name, "Biceps Brachii");
  EXPECT_EQ(chosen.values()(0, 0), 1.0);
}

TEST(ChannelChoice, AChannelOfAnotherClockBringsItsOwnTimes) {
  const TimeSeries chosen = choose_channels(two_clocks(), {"acc x"}, "f.csv");
  EXPECT_NEAR(chosen.mean_rate_hz(), 148.0, 1e-9);
}

TEST(ChannelChoice, AWrongNameIsToldWithTheFileTheNearestNameAndAllNames) {
  EXPECT_THAT(refusal({"Tricep"}), AllOf(HasSubstr("f.csv"), HasSubstr("'Tricep'"), HasSubstr("'Triceps'"),
                                         HasSubstr("Biceps Brachii, "), HasSubstr("ACC X")));
}

TEST(ChannelChoice, ChannelsOfTwoClocksAreToldApart) {
  EXPECT_THAT(refusal({"Triceps", "ACC X"}),
              AllOf(HasSubstr("different clocks"), HasSubstr("2000 Hz"), HasSubstr("148 Hz")));
}

TEST(ChannelChoice, AChannelWithAGapIsLeftOutWithItsTimeAndTheOthersStay) {
  TimeSeries whole = series({"A", "B", "C"}, 100.0);
  std::vector<Repair> repairs;
  EXPECT_EQ(without_gaps(whole, repairs).channel_count(), 3);
  EXPECT_TRUE(repairs.empty());
  Eigen::MatrixXd values = whole.values();
  values(1, 1) = std::nan("");
  values(2, 1) = INFINITY;
  const TimeSeries broken(whole.time_s(), whole.channels(), values);
  const TimeSeries left = without_gaps(broken, repairs);
  ASSERT_EQ(left.channel_count(), 2);
  EXPECT_EQ(left.channels()[1].name, "C");
  EXPECT_EQ(left.values()(2, 1), 2.0);
  ASSERT_EQ(repairs.size(), 1U);
  EXPECT_EQ(repairs[0].message.find("channel 'B'"), 0U) << repairs[0].message;
  EXPECT_NE(repairs[0].message.find("0.01 s (2 samples)"), std::string::npos) << repairs[0].message;
}

}  // namespace
}  // namespace myoid::recording
