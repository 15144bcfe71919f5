#include "myoid/recording/makers/labchart_layout.h"

#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/makers/emg_table.h"

#include "tests/support/message_of.h"
#include "tests/support/repair_lines.h"

namespace myoid::recording {
namespace {

using ::testing::HasSubstr;

/// The lines above a block, at a time in days.
std::string head(double days, const std::string& titles = "Torque\tEMG BIC") {
  return fmt::format(
      "Interval=\t0.001 s\nExcelDateTime=\t{:.13e}\t02/03/21 "
      "10:11:12.000000\nTimeFormat=\tStartOfBlock\nDateFormat=\t\n"
      "ChannelTitle=\t{}\nRange=\t10.000 V\t2.000 mV\nUnitName=\tNm\t*\nTopValue=\t250.0\t*\nBottomValue=\t-250.0\t*\n",
      days, titles);
}

constexpr double kDay = 44230.0;

TEST(LabChart, UnitsAreConvertedOnesOrThoseOfTheRange) {
  const CsvSeries s = parse_emg_table(head(kDay) + "0\t1.5\t0.25\n0.001\t2.5\t-0.5\n0.002\t3.5\t1\n", "a.txt");
  ASSERT_EQ(s.data.channel_count(), 2);
  EXPECT_EQ(s.data.channels()[0], (Channel{"Torque", Unit::newton_meter}));
  EXPECT_EQ(s.data.channels()[1], (Channel{"EMG BIC", Unit::volt}));
  EXPECT_EQ(s.data.values()(1, 0), 2.5);
  EXPECT_DOUBLE_EQ(s.data.values()(1, 1), -0.5e-3);
  EXPECT_DOUBLE_EQ(s.data.time_s()[2], 0.002);
}

TEST(LabChart, CommaDecimalsAndRowsWithoutTimesAreRead) {
  EXPECT_DOUBLE_EQ(parse_emg_table(head(kDay) + "0\t1,5\t0,25\n0,001\t2,5\t-0,5\n", "a.txt").data.values()(1, 0), 2.5);
  const CsvSeries s = parse_emg_table(head(kDay) + "1.5\t0.25\n2.5\t-0.5\n3.5\t1\n", "a.txt");
  EXPECT_DOUBLE_EQ(s.data.time_s()[2], 0.002);
  EXPECT_EQ(s.data.values()(2, 0), 3.5);
}

TEST(LabChart, CommentsBecomeEventsAndNoCells) {
  const CsvSeries s =
      parse_emg_table(head(kDay) + "0\t1\t2\n0.001\t1\t2\t#* go now\n0.002\t1\t2\n0.003\t1\t2\t#2 #1 lift\n", "a.txt");
  ASSERT_EQ(s.data.sample_count(), 4);
  ASSERT_EQ(s.events.size(), 2U);
  EXPECT_EQ(s.events[0].label, "go now");
  EXPECT_DOUBLE_EQ(s.events[0].time_s, 0.001);
  EXPECT_EQ(s.events[1].label, "#1 lift");
  EXPECT_DOUBLE_EQ(s.events[1].time_s, 0.003);
}

TEST(LabChart, BlocksStandWhereTheirDatesPutThem) {
  const std::string rows = "0\t1\t2\n0.001\t3\t4\t#* mark\n";
  const CsvSeries s = parse_emg_table(head(kDay) + rows + head(kDay + 12.5 / 86400.0) + rows, "a.txt");
  ASSERT_EQ(s.data.sample_count(), 4);
  EXPECT_NEAR(s.data.time_s()[2], 12.5, 1e-5);  // 13 decimals of a day's number are 1e-9 days of 44230
  EXPECT_NEAR(s.data.time_s()[3], 12.501, 1e-5);
  EXPECT_EQ(s.data.values()(3, 1), 4e-3);
  ASSERT_EQ(s.events.size(), 2U);
  EXPECT_NEAR(s.events[1].time_s, 12.501, 1e-5);
  EXPECT_THAT(test::repair_lines(s.repairs), HasSubstr("21: block 2: "));
}

TEST(LabChart, ABlockWithoutADateOfItsOwnIsSetApartAndThisIsSaid) {
  const std::string rows = "0\t1\t2\n0.001\t3\t4\n";
  const CsvSeries s = parse_emg_table(head(kDay) + rows + head(kDay) + rows, "a.txt");
  ASSERT_EQ(s.data.sample_count(), 4);
  EXPECT_NEAR(s.data.time_s()[2], 1.002, 1e-12);
  EXPECT_THAT(test::repair_lines(s.repairs), HasSubstr("how long"));
}

TEST(LabChart, BlocksOfOtherChannelsAndRowsOfAnotherWidthAreRefused) {
  const auto refusal = [](const std::string& text) -> std::string {
    return test::message_of<ReadError>([&] { (void)parse_emg_table(text, "a.txt"); });
  };
  const std::string rows = "0\t1\t2\n0.001\t3\t4\n";
  EXPECT_THAT(refusal(head(kDay) + rows + head(kDay, "Torque\tEMG TRI") + rows), HasSubstr("a.txt:16: "));
  EXPECT_THAT(refusal(head(kDay) + "0\n0.001\n"), HasSubstr("a.txt:10: "));
  EXPECT_THAT(refusal(head(kDay)), HasSubstr("no rows"));
}

}  // namespace
}  // namespace myoid::recording
