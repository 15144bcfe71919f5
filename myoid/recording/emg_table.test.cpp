#include "myoid/recording/emg_table.h"

#include <gtest/gtest.h>

#include "myoid/core/error.h"
#include "myoid/recording/emg_table_layout.h"

namespace myoid::recording {
namespace {

TEST(EmgTable, APlainTableIsReadAsEver) {
  const CsvSeries s = parse_emg_table("# remark\ntime,Biceps [mV],knee\n0,1,2\n0.5,3,\n", "a.csv");
  EXPECT_EQ(s.data.channels()[0], (Channel{"Biceps", Unit::volt}));
  EXPECT_DOUBLE_EQ(s.data.values()(1, 0), 3e-3);
  EXPECT_EQ(s.has_unit, (std::vector<bool>{true, false}));
}

TEST(EmgTable, ATimeColumnForEachChannelGivesOneClock) {
  // As wireless systems export: EMG and acceleration in pairs of columns of different length.
  const CsvSeries s = parse_emg_table(
      "Label: Biceps: EMG 1 Sampling frequency: 2000 Unit: mV Domain: Time\n"
      "X [s],\"Biceps: EMG 1 [mV]\",X [s],\"Biceps: ACC.X 1 [g]\",X [s],\"Triceps: EMG 2 [mV]\"\n"
      "0,1,0,0.5,0,4\n0.0005,2,0.0067,0.6,0.0005,5\n0.001,3,0.0135,0.7,0.001,6\n0.0015,7,,,,\n",
      "a.csv");
  ASSERT_EQ(s.data.channel_count(), 2);
  EXPECT_EQ(s.data.channels()[1], (Channel{"Triceps: EMG 2", Unit::volt}));
  ASSERT_EQ(s.data.sample_count(), 3);
  EXPECT_DOUBLE_EQ(s.data.time_s()[2], 0.001);
  EXPECT_DOUBLE_EQ(s.data.values()(2, 1), 6e-3);
  EXPECT_EQ(s.repairs.size(), 3U);  // other clock, joined, cut to the shortest
}

TEST(EmgTable, MetadataAndARowOfUnitsAreUnderstood) {
  const CsvSeries s = parse_emg_table(
      "Type;EMG\r\nFrequency;1500\r\nDate;2024-01-02\r\n\r\ntime;LT BICEPS;RT TRICEPS\r\n"
      "s;uV;uV\r\n0,000;1,5;-2,5\r\n0,001;2,5;3\r\n",
      "a.csv");
  EXPECT_EQ(s.data.channels()[0], (Channel{"LT BICEPS", Unit::volt}));
  EXPECT_DOUBLE_EQ(s.data.values()(0, 1), -2.5e-6);
  EXPECT_DOUBLE_EQ(s.data.time_s()[1], 0.001);
}

TEST(EmgTable, UnitsBehindACommaAndFrameNumbersAreUnderstood) {
  const CsvSeries s = parse_emg_table(
      "Frame,\"Time, s\",\"BICEPS, uV\",\"TRICEPS, uV\"\n1,0,10,20\n2,0.001,30,40\n", "a.csv");
  EXPECT_EQ(s.data.channel_count(), 2);
  EXPECT_EQ(s.data.channels()[0], (Channel{"BICEPS", Unit::volt}));
  EXPECT_DOUBLE_EQ(s.data.values()(1, 1), 40e-6);
}

TEST(EmgTable, WithoutATimeColumnTheStatedRateIsTheClock) {
  const std::string body = "EMG1\tEMG2\n1\t2\n3\t4\n5\t6\n";
  const CsvSeries s = parse_emg_table("Export of 2024\nSampling rate: 2000 Hz\n" + body, "a.txt");
  EXPECT_DOUBLE_EQ(s.data.time_s()[2], 0.001);
  EXPECT_DOUBLE_EQ(s.data.values()(2, 1), 6.0);
  EXPECT_EQ(s.has_unit, (std::vector<bool>{false, false}));
  EXPECT_THROW(static_cast<void>(parse_emg_table("Export\n" + body, "a.txt")), ReadError);
}

TEST(EmgTable, ATriggerCalledTIsNoSecondClock) {
  const CsvSeries s = parse_emg_table("time,E1 [mV],T\n0,1,0\n0.001,2,5\n0.002,3,0\n", "a.csv");
  EXPECT_EQ(s.data.channel_count(), 2);
  EXPECT_DOUBLE_EQ(s.data.column("T")[1], 5.0);
  EXPECT_TRUE(s.repairs.empty());
  const CsvSeries pairs = parse_emg_table("t,E1 [mV],t,E2 [mV]\n0,1,0,2\n1,3,1,4\n", "a.csv");
  EXPECT_EQ(pairs.data.channel_count(), 2);
  EXPECT_DOUBLE_EQ(pairs.data.column("E2")[1], 4e-3);
}

TEST(EmgTable, WhatIsWrongIsSaidWithItsLine) {
  try {
    static_cast<void>(
        parse_emg_table("Frequency;1000\ntime;a\ns;mV\n0;1\n0.1;2\n0.2;x\n0.3;4\n", "a.csv"));
    FAIL();
  } catch (const ReadError& error) {
    EXPECT_EQ(error.line(), 6U);
  }
  EXPECT_THROW(static_cast<void>(parse_emg_table("no table at all\n", "a.csv")), ReadError);
  EXPECT_THROW(static_cast<void>(parse_emg_table("X [s],a\n0,1\n0,2\n0,3\n", "a.csv")), ReadError);
}

TEST(EmgTable, AChannelBeforeTheFirstOfTwoTimeColumnsHasItsClock) {
  // Found by fuzzing: it had none, and no rate either.
  const CsvSeries s = parse_emg_table(
      "A [mV],X [s],\"EMG 1 [mV]\",X [s],\"EMG 2 [mV]\"\n7,0,1,0,2\n8,0.1,3,0.1,4\n", "a.csv");
  EXPECT_EQ(s.data.channel_count(), 3);
  EXPECT_DOUBLE_EQ(s.data.column("A")[1], 8e-3);
  EXPECT_DOUBLE_EQ(s.data.time_s()[1], 0.1);
}

TEST(EmgTableLayout, NamesStandAboveTheFirstRowsOfNumbersAndUnitsBetween) {
  const std::vector<std::string_view> lines{
      "Some lab", "Sampling rate: 1000 Hz", "", "Frame,E1,E2", ",mV,uV", "1,0.5,7", "2,0.25,8"};
  const auto layout = emg_table::find_table(lines, ',');
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->names_row, 3U);
  EXPECT_EQ(layout->first_row, 5U);
  EXPECT_EQ(layout->rate_hz, 1000.0);
  ASSERT_EQ(layout->labels.size(), 3U);
  EXPECT_EQ(layout->labels[2].unit->to_si, 1e-6);
  EXPECT_FALSE(emg_table::is_plain(lines, *layout));
  EXPECT_FALSE(emg_table::find_table(lines, ';'));
}

}  // namespace
}  // namespace myoid::recording
