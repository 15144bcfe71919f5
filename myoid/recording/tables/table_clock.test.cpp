#include "myoid/recording/tables/table_clock.h"

#include <string>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/makers/emg_table.h"
#include "myoid/recording/makers/nexus_section.h"
#include "myoid/recording/tables/channel_labels.h"
#include "myoid/recording/tables/table_layout.h"
#include "myoid/recording/tables/table_series.h"

#include "tests/support/message_of.h"
#include "tests/support/repair_lines.h"

namespace myoid::recording {
namespace {

using ::testing::HasSubstr;

/// Devices at 2000 Hz with 4 sub-frames a frame, from frame 11 to 13.
std::string rows(int from, int to) {
  std::string text;
  for (int i = from; i < to; ++i)
    text += std::to_string(11 + i / 4) + "," + std::to_string(i % 4) + "," + std::to_string(i) + "\n";
  return text;
}

Eigen::VectorXd times(const std::string& text, double frame_rate_hz, std::vector<Repair>& repairs) {
  TableLayout layout;
  layout.columns = {{TableColumn::Kind::frame, "Frame"},
                    {TableColumn::Kind::sub_frame, "Sub Frame"},
                    {TableColumn::Kind::channel, "E"}};
  layout.end_row = 1000;
  layout.rate_hz = 2000.0;
  layout.frame_rate_hz = frame_rate_hz;
  const TableText table(text);
  return row_times(layout, read_rows(table, rows_of(layout), "f.csv"), "f.csv", repairs);
}

TEST(RowTimes, FramesAndSubFramesAreTheClockOfACroppedTrial) {
  // Frame 11 of a camera at 500 Hz is 10 / 500 s behind frame 1; with or without the stated rate.
  for (const double frame_rate_hz : {0.0, 500.0}) {
    std::vector<Repair> repairs;
    const Eigen::VectorXd t = times(rows(0, 12), frame_rate_hz, repairs);
    ASSERT_EQ(t.size(), 12);
    for (int i = 0; i < 12; ++i) EXPECT_NEAR(t[i], 0.02 + i / 2000.0, 1e-15);
    EXPECT_TRUE(repairs.empty());
  }
}

TEST(RowTimes, LostSubFramesAreAGapAndDoubledOrReversedOnesAreRefused) {
  std::vector<Repair> repairs;
  const Eigen::VectorXd t = times(rows(0, 5) + rows(7, 12), 500.0, repairs);
  EXPECT_NEAR(t[5] - t[4], 3.0 / 2000.0, 1e-15);
  EXPECT_THAT(test::repair_lines(repairs), HasSubstr("6: 2 rows"));
  const auto refusal = [&](const std::string& text, double frame_rate_hz) -> std::string {
    return test::message_of<ReadError>([&] { (void)times(text, frame_rate_hz, repairs); });
  };
  EXPECT_THAT(refusal(rows(0, 5) + rows(4, 12), 500.0), HasSubstr("f.csv:6: frame 12, sub-frame 0"));
  EXPECT_THAT(refusal(rows(5, 12) + rows(0, 5), 500.0), HasSubstr("increase"));
  EXPECT_THAT(refusal(rows(0, 12), 250.0), HasSubstr("rate"));
  EXPECT_THAT(refusal(rows(0, 4) + "12,9,1\n" + rows(5, 12), 500.0), HasSubstr("frames have 4"));
  EXPECT_THAT(refusal(rows(0, 3), 0.0), HasSubstr("frame"));
  EXPECT_THAT(refusal("11,0,1\n11.5,1,2\n", 500.0), HasSubstr("11.5"));
}

TEST(RowTimes, EverySecondFrameOfATakeIsNoGap) {
  const auto stated = [](const std::string& text) {
    TableLayout layout;
    layout.columns = {
        {TableColumn::Kind::frame, "Frame"}, {TableColumn::Kind::time, "Time"}, {TableColumn::Kind::channel, "E"}};
    layout.end_row = 1000;
    layout.rate_hz = 120.0;
    std::vector<Repair> repairs;
    const TableText table(text);
    const Eigen::VectorXd t = row_times(layout, read_rows(table, rows_of(layout), "f.csv"), "f.csv", repairs);
    EXPECT_NEAR(t[1] - t[0], 1.0 / 60.0, 1e-6);
    return test::repair_lines(repairs);
  };
  EXPECT_EQ(stated("0,0,7\n2,0.016667,7\n4,0.033333,7\n6,0.05,7\n"), "");
  EXPECT_THAT(stated("0,0,7\n2,0.016667,7\n6,0.05,7\n8,0.066667,7\n"), HasSubstr("3: 1 row"));
}

TEST(RowTimes, AStepThatIsNotAsTheOthersIsStatedAndRoundingIsNot) {
  const auto stated = [](Eigen::VectorXd time) {
    std::vector<Repair> repairs;
    std::vector<std::size_t> lines;
    for (Eigen::Index i = 0; i < time.size(); ++i) lines.push_back(static_cast<std::size_t>(i + 1));
    state_uneven_step(time, lines, "t", repairs);
    return test::repair_lines(repairs);
  };
  Eigen::VectorXd even = Eigen::VectorXd::LinSpaced(400, 0.0, 399 * 0.0005);
  EXPECT_EQ(stated(even), "");
  EXPECT_EQ(stated((Eigen::VectorXd::LinSpaced(400, 0.0, 399 / 2000.4) * 1e5).array().round() / 1e5), "");
  Eigen::VectorXd lost = even;
  lost.tail(200).array() += 0.0005;
  EXPECT_THAT(stated(lost), HasSubstr("201: 't' steps by 0.001 s, 0.0005 s elsewhere"));
  // A clock that ticks in millionths of a second and is off by one tick twice has lost no row.
  Eigen::VectorXd ticks = (Eigen::VectorXd::LinSpaced(400, 0.0, 399 * 0.00045) * 1e6).array().round() / 1e6;
  ticks[100] += 1e-6;
  ticks[300] -= 1e-6;
  EXPECT_EQ(stated(ticks), "");
  Eigen::VectorXd wrong = even;
  wrong[100] += 0.0001;
  EXPECT_THAT(stated(wrong), HasSubstr("101: 't' steps by 0.0006 s"));
}

/// A table of `rows` rows with a value each, whose times `write` writes.
template <typename Write>
CsvSeries clocked(const std::string& head, int rows, const Write& write) {
  std::string text = head;
  for (int i = 0; i < rows; ++i) text += fmt::format("{},{}\n", write(i), i % 7);
  return parse_emg_table(text, "a.csv");
}

TEST(TableClock, TimesOfTheDayGoOnBehindMidnight) {
  const CsvSeries s = clocked("Time,EMG [mV]\n", 4, [](int i) {
    return i < 2 ? fmt::format("23:59:59.{}", 8 + i) : fmt::format("00:00:00.{}", i - 2);
  });
  EXPECT_NEAR(s.data.time_s()[3] - s.data.time_s()[0], 0.3, 1e-9);
  // A step back within a day is none.
  EXPECT_THROW((void)clocked("Time,EMG [mV]\n", 4, [](int i) { return fmt::format("10:00:0{}.0", 4 - i); }), ReadError);
}

TEST(TableClock, TimesThatRoundingMadeEqualAreEven) {
  // 2 kHz with three decimals: each time stands twice.
  for (const std::string head : {"time,EMG [mV]\n", "Sampling rate: 2000 Hz\ntime,EMG [mV]\n"}) {
    const CsvSeries s = clocked(head, 2000, [](int i) { return fmt::format("{:.3f}", 5.0 + i / 2000.0); });
    ASSERT_EQ(s.data.sample_count(), 2000);
    for (const int i : {0, 1, 1999}) EXPECT_NEAR(s.data.time_s()[i], 5.0 + i / 2000.0, 5e-4) << i;
    EXPECT_NEAR(s.data.mean_rate_hz(), 2000.0, 0.1);
    ASSERT_EQ(s.repairs.size(), 1U);
    EXPECT_EQ(s.repairs[0].line, head.starts_with("time") ? 3U : 4U);
  }
  // Whole seconds of a short recording do not tell the rate; the header does.
  const auto whole = [](int i) { return fmt::format("10:00:0{}", i / 50); };
  EXPECT_THROW((void)clocked("time,EMG [mV]\n", 200, whole), ReadError);
  const CsvSeries stated = clocked("Sampling rate: 50 Hz\ntime,EMG [mV]\n", 200, whole);
  EXPECT_NEAR(stated.data.time_s()[199] - stated.data.time_s()[0], 199 / 50.0, 1e-9);
  // Times that repeat and are not even, and a row that stands twice.
  EXPECT_THROW((void)clocked("time,EMG [mV]\n", 200, [](int i) { return i < 100 ? i / 10 : i; }), ReadError);
  EXPECT_THROW((void)clocked("time,EMG [mV]\n", 200, [](int i) { return 0.01 * (i < 100 ? i : i - 1); }), ReadError);
}

TEST(TableClock, AClockWithoutAUnitMayCountMillisecondsOrDays) {
  // The stated rate says that 0, 1, 2, ... are milliseconds.
  const CsvSeries ms = clocked("Sampling rate: 1000 Hz\ntime,EMG [mV]\n", 100, [](int i) { return i; });
  EXPECT_DOUBLE_EQ(ms.data.time_s()[99], 0.099);
  const CsvSeries us = clocked("Sampling rate: 500 Hz\ntime,EMG [mV]\n", 100, [](int i) { return 7000 + 2000 * i; });
  EXPECT_DOUBLE_EQ(us.data.time_s()[99], 0.205);
  // A spreadsheet counts days since 1900.
  const CsvSeries days =
      clocked("Time,EMG [mV]\n", 100, [](int i) { return fmt::format("{:.10f}", 46143.41873842 + i * 0.01 / 86400); });
  EXPECT_NEAR(days.data.mean_rate_hz(), 100.0, 0.01);
  EXPECT_EQ(days.repairs.size(), 1U);
  // Otherwise the column counts seconds, which is in doubt where a second or more lies between rows.
  const CsvSeries slow = clocked("time,EMG [mV]\n", 100, [](int i) { return i; });
  EXPECT_DOUBLE_EQ(slow.data.time_s()[99], 99.0);
  ASSERT_EQ(slow.repairs.size(), 1U);
  EXPECT_DOUBLE_EQ(slow.repairs[0].apart_s, 98.901);  // 99 s or 99 ms
  EXPECT_TRUE(clocked("time [s],EMG [mV]\n", 100, [](int i) { return i; }).repairs.empty());
}

TEST(ChannelLabels, UnitsAndRatesAreTakenOffTheName) {
  EXPECT_EQ(take_label_apart("BIC [mV]").unit->to_si, 1e-3);
  EXPECT_EQ(take_label_apart("BIC, uV").name, "BIC");
  const TableColumn rated = take_label_apart("EMG 1 (1259Hz)");
  EXPECT_EQ(rated.name, "EMG 1");
  EXPECT_NEAR(rated.rate_hz, 34.0 / 0.027, 1e-9);
  EXPECT_EQ(packet_rate(1500.0), 1500.0);  // no packet rate is within half a Hz
  EXPECT_EQ(rate_in_line("Sampling rate: 2000 Hz")->hz, 2000.0);
  for (const char* line : {"Sampling rate: 2 kHz", "Sampling rate: 2.0kHz", "sampling rate [kHz]: 2", "rate;2;kHz"})
    EXPECT_EQ(rate_in_line(line)->hz, 2000.0) << line;
  for (const char* line :
       {"Sampling rate;2,0 kHz", "Sampling rate: 2,000 kHz", "Sampling rate: 2,000 Hz", "rate;2,0;kHz"})
    EXPECT_EQ(rate_in_line(line)->hz, 2000.0) << line;
  for (const char* line : {"Sampling rate;1925,926 Hz", "Sampling rate: 1925,926Hz", "Sampling rate\t1925,926"})
    EXPECT_EQ(rate_in_line(line)->hz, 1925.926) << line;
  EXPECT_EQ(rate_in_line("Sampling rate: 148,148 Hz")->hz, 148.148);
  EXPECT_EQ(rate_in_line("rate,2000,1,EMG")->hz, 2000.0);  // cells between commas
  EXPECT_EQ(rate_in_line("Sampling rate: 0.002 MHz")->other_unit, "mhz");
  EXPECT_EQ(rate_in_line("Sampling rate: 5 ms")->other_unit, "ms");
  EXPECT_EQ(rate_in_cell("2 kHz"), 2000.0);
  EXPECT_FALSE(take_label_apart("EMG (left)").unit);
}

TEST(NexusSection, ATableOfDevicesSharesTheFrameNumbersOfItsTrajectories) {
  const std::string text = "Devices\n2000\n,,EMG,\nFrame,Sub Frame,BIC,TRI\n,,mV,mV\n" +
                           std::string("200,0,1,2\n200,1,3,4\n\n") +
                           "Trajectories\n1000\n,,A,,\nFrame,Sub Frame,X,Y,Z\n,,mm,mm,mm\n200,0,1,2,3\n\nJoints\n100\n";
  const TableText table(text);
  EXPECT_EQ(nexus_frame_rate(table), 1000.0);
  const auto section = nexus_section(table, "Devices", "f.csv");
  ASSERT_TRUE(section);
  EXPECT_EQ(section->layout.end_row - section->layout.first_row, 2U);
  EXPECT_THAT(test::repair_lines(section->layout.repairs), HasSubstr("not read: Joints"));
  EXPECT_FALSE(nexus_section(table, "Model Outputs", "f.csv"));
}

TEST(TableLayout, ANumberStandsBehindItsWordInItsCellOrBelowIt) {
  const TableText text("NO_OF_FRAMES\t40\nRate: 100 Hz\ntype\tcount\tsex\nrecord\t7\tmale\n");
  EXPECT_EQ(stated_number(text, 4, '\t', {"no_of_frames"}), 40.0);
  EXPECT_EQ(stated_number(text, 4, '\t', {"rate"}), 100.0);
  EXPECT_EQ(stated_number(text, 4, '\t', {"count"}), 7.0);
  EXPECT_FALSE(stated_number(text, 3, '\t', {"count"}));
  EXPECT_EQ(stated_number(TableText("Rate;1925,926 Hz\nA;B\n"), 2, ';', {"rate"}), 1925.926);
  EXPECT_EQ(stated_text(text, 4, '\t', "record"), "7");
}

TEST(TableLayout, ABlankLineEndsABlockUnlessRowsOfNumbersFollow) {
  EXPECT_EQ(end_of_block(TableText("1,2\n2,3\n\nJoints\n100\n"), 0, ','), 2U);
  EXPECT_EQ(end_of_block(TableText("1,2\n\n2,3\n"), 0, ','), 3U);
  EXPECT_EQ(end_of_block(TableText("1,2\n,\n2,3\n,,\n"), 0, ','), 3U);
}

TEST(ChannelsOfTable, EveryChannelHasANameOfItsOwn) {
  TableLayout layout;
  layout.columns = {{TableColumn::Kind::time, "t"},
                    {TableColumn::Kind::channel, "a"},
                    {TableColumn::Kind::channel, ""},
                    {TableColumn::Kind::channel, "a"}};
  layout.end_row = 9;
  const CsvSeries s = channels_of_table(TableText("0,1,2,3\n1,1,2,3\n"), layout, "f.csv");
  EXPECT_EQ(s.data.channels()[1].name, "channel_2");
  EXPECT_EQ(s.data.channels()[2].name, "a_2");
  EXPECT_EQ(s.repairs.size(), 2U);
}

}  // namespace
}  // namespace myoid::recording
