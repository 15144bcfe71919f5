#include "myoid/recording/makers/emg_table.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/tables/text_table.h"

namespace myoid::recording {
namespace {

TEST(EmgTable, APlainTableIsReadAsEver) {
  const CsvSeries s = parse_emg_table("# remark\ntime,Biceps [mV],knee\n0,1,2\n0.5,3,\n", "a.csv");
  EXPECT_EQ(s.data.channels()[0], (Channel{"Biceps", Unit::volt}));
  EXPECT_DOUBLE_EQ(s.data.values()(1, 0), 3e-3);
  EXPECT_EQ(s.has_unit, (std::vector<bool>{true, false}));
}

TEST(EmgTable, ATimeColumnForEachChannelGivesAClockForEachRate) {
  // A table as wireless systems export it: EMG and acceleration in pairs of columns of different length.
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
  ASSERT_EQ(s.other_clocks.size(), 1U);
  const TimeSeries& acceleration = s.other_clocks[0].data;
  EXPECT_EQ(acceleration.channels()[0].name, "Biceps: ACC.X 1");
  EXPECT_EQ(acceleration.time_s(), Eigen::Vector3d(0.0, 0.0067, 0.0135));
  EXPECT_NEAR(acceleration.values()(2, 0), 0.7 * kStandardGravity, 1e-12);
  EXPECT_EQ(s.repairs.size(), 2U);  // two clocks, cut to the shortest
}

TEST(EmgTable, WrittenTimesMayHaveTheirPatternForAUnit) {
  const CsvSeries s = parse_emg_table(
      "\"sep=\t\"\nDev_1_Accel_X_CAL\tDev_1_TimestampSync_FormattedUnix_CAL\tDev_1_EMG_CH1_CAL\t\n"
      "m/(s^2)\tyyyy/mm/dd hh:mm:ss.000\tmV\t\n9.5\t2024/02/29 23:59:59.998\t-0.5\t\n"
      "9.5\t2024/03/01 00:00:00.000\t0.25\t\n9.75\t2024/03/01 00:00:00.002\t0.75\t\n",
      "a.csv");
  ASSERT_EQ(s.data.channel_count(), 2);
  EXPECT_NEAR(s.data.mean_rate_hz(), 500.0, 0.1);
  EXPECT_EQ(s.data.channels()[1], (Channel{"Dev_1_EMG_CH1_CAL", Unit::volt}));
  EXPECT_DOUBLE_EQ(s.data.values()(2, 1), 0.75e-3);
}

TEST(EmgTable, AMarkOfCommentsAloneIsNoRowOfNames) {
  const CsvSeries s =
      parse_emg_table("# Sampling Rate (Hz):= 1000.00\n# BIC\tTRI\n#\n498\t1\n499\t2\n497\t4\n", "a.txt");
  ASSERT_EQ(s.data.channel_count(), 2);
  EXPECT_EQ(s.data.channels()[0].name, "BIC");
  EXPECT_EQ(s.data.values()(2, 0), 497.0);
  EXPECT_NEAR(s.data.mean_rate_hz(), 1000.0, 1e-9);
}

TEST(EmgTable, AnUnknownUnitBesideKnownOnesMakesNoNamesOfTheUnits) {
  const CsvSeries s = parse_emg_table(
      "BioWare\nRate:\t100\n\nabs time (s)\tFx\tFz\tMx\tQ\n\tN\tN\tN.m\td.u.\n0\t1\t2\t3\t4\n0.01\t1\t2\t3\t4\n",
      "a.txt");
  ASSERT_EQ(s.data.channel_count(), 4);
  EXPECT_EQ(s.data.channels()[2], (Channel{"Mx", Unit::newton_meter}));
  EXPECT_EQ(s.data.channels()[3], (Channel{"Q", Unit::dimensionless}));
  EXPECT_EQ(s.has_unit, (std::vector<bool>{true, true, true, false}));
  EXPECT_EQ(s.repairs.size(), 1U);
}

TEST(EmgTable, ATimeThatIsMissingBeforeOthersIsNoEndOfItsChannel) {
  const auto read = [](const std::string& row) {
    return parse_emg_table("X [s],A [V],X [s],B [V]\n0,1,0,2\n" + row + "0.2,1,0.2,2\n", "a.csv");
  };
  EXPECT_EQ(read("0.1,1,0.1,2\n").data.sample_count(), 3);
  EXPECT_THROW((void)read("0.1,1,,2\n"), ReadError);
  EXPECT_THROW((void)read("0.1,1,2\n"), ReadError);
}

TEST(EmgTable, RatesInTheNamesOrInARowBelowThemAreTheClocks) {
  for (const bool row : {false, true}) {
    const std::string names =
        row ? "EMG 1 (mV), ACC X (G), EMG 1 (mV)\n 74.0741 Hz, 37.037037037037038 Hz, 74.0741 Hz\n"
            : "EMG 1 (74Hz), ACC X (37Hz), EMG 1 (74Hz), \n";
    const CsvSeries s = parse_emg_table(
        "Application:, Trigno Discover (1.4.2)\nCollection Length (seconds):, 0.06\n"
        "EMG 01 (5471), , EMG 02 (5524), \nsensor mode: 55, , sensor mode: 55, \n" +
            names + "1, 7, 4\n2, 8, 5\n3, , 6\n",
        "a.csv");
    ASSERT_EQ(s.data.channel_count(), 2) << row;
    EXPECT_EQ(s.data.channels()[0].name, "EMG 01 (5471) EMG 1");
    EXPECT_EQ(s.data.channels()[1].name, "EMG 02 (5524) EMG 1");
    EXPECT_EQ(s.has_unit[0], row);
    EXPECT_DOUBLE_EQ(s.data.values()(2, 1), row ? 6e-3 : 6.0);
    EXPECT_NEAR(s.data.time_s()[2], 2 * 0.0135, 1e-6);  // 74 Hz is 2 samples in 27 ms
    ASSERT_EQ(s.other_clocks.size(), 1U);
    EXPECT_EQ(s.other_clocks[0].data.sample_count(), 2);
    EXPECT_NEAR(s.other_clocks[0].data.time_s()[1], 0.027, 1e-12);
  }
}

TEST(EmgTable, ARemarkInAColumnOfTextIsAnEventAndNoName) {
  const CsvSeries s = parse_emg_table(
      "\"type\";\"begin_time\";\"frequency\";\"count\"\n\"record\";\"0,00\";\"2000\";\"3\"\n\n"
      "\"time\";\"Activity\";\"Marker\";\"BIC LT (uV)\"\n0,0000;\"Rest\";;0\n0,0005;;;7,25\n"
      "0,0010;;\"here\";14,5\n",
      "a.csv");
  ASSERT_EQ(s.data.sample_count(), 3);
  EXPECT_EQ(s.data.channels(), (std::vector<Channel>{{"BIC LT", Unit::volt}}));
  EXPECT_DOUBLE_EQ(s.data.values()(1, 0), 7.25e-6);
  ASSERT_EQ(s.events.size(), 2U);
  EXPECT_EQ(s.events[0].label, "Rest");
  EXPECT_EQ(s.events[0].context, "Activity");
  EXPECT_DOUBLE_EQ(s.events[1].time_s, 0.001);
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
  const CsvSeries s =
      parse_emg_table("Frame,\"Time, s\",\"BICEPS, uV\",\"TRICEPS, uV\"\n1,0,10,20\n2,0.001,30,40\n", "a.csv");
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

TEST(EmgTable, AStatedRateBesideOtherTimesIsApartAtTheEnd) {
  std::string rows = "time,VL [uV]\n";
  for (int i = 0; i <= 400; ++i) rows += fmt::format("{},{}\n", 0.0125 * i, i % 7);
  for (const char* head : {"Export of 2024\nSampling rate: 100 Hz\n", "# rate = 100 Hz\n"}) {
    const CsvSeries s = parse_emg_table(head + rows, "a.csv");
    ASSERT_EQ(s.repairs.size(), 1U) << head;
    EXPECT_NEAR(s.repairs[0].apart_s, 1.0, 1e-9);  // 400 intervals take 4 s and 5 s
  }
}

TEST(EmgTable, ARateInAnotherUnitIsRefusedWhereItIsTheOnlyClock) {
  try {
    (void)parse_emg_table("Export of 2024\nSampling rate: 5 ms\nVL [uV],BF [uV]\n1,2\n3,4\n", "a.csv");
    ADD_FAILURE();
  } catch (const ReadError& error) {
    EXPECT_NE(std::string(error.what()).find("a.csv:2: "), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("'ms'"), std::string::npos);
  }
  const CsvSeries timed =
      parse_emg_table("Export of 2024\nSampling rate: 5 ms\ntime,VL [uV],BF [uV]\n0,1,2\n0.005,3,4\n", "a.csv");
  EXPECT_EQ(timed.data.time_s()[1], 0.005);
}

TEST(EmgTable, OnlyTheRateOfTheSamplesIsTheClock) {
  const std::string body = "VL [uV],BF [uV]\n1,2\n3,4\n5,6\n";
  for (const std::string other :
       {"Heart rate: 72", "High pass frequency: 20 Hz", "Cut-off frequency (Hz): 450", "Mains frequency,50,Hz",
        "Frame rate: 100 Hz", "Baud rate: 9600", "Rate of perceived exertion: 13"}) {
    const CsvSeries s = parse_emg_table(other + "\nSampling rate: 1000 Hz\n" + body, "a.csv");
    EXPECT_DOUBLE_EQ(s.data.time_s()[2], 0.002) << other;
    if (other.starts_with("Frame")) continue;
    EXPECT_THROW((void)parse_emg_table(other + "\n" + body, "a.csv"), ReadError) << other;
  }
  EXPECT_DOUBLE_EQ(parse_emg_table("OutputRate:,60Hz\n" + body, "a.csv").data.time_s()[2], 2.0 / 60.0);
  EXPECT_DOUBLE_EQ(parse_emg_table("Frequence d'echantillonnage : 500 Hz\n" + body, "a.csv").data.time_s()[2], 0.004);
  // Two rates of which either may be that of the rows.
  try {
    (void)parse_emg_table("Frame rate: 100 Hz\nEMG rate: 2000 Hz\n" + body, "a.csv");
    ADD_FAILURE();
  } catch (const ReadError& error) {
    EXPECT_EQ(error.line(), 2U);
  }
}

// Shimmer writes a line for spreadsheets, a row of units, and milliseconds since 1970 under a name of many words.
TEST(EmgTable, AWordTimestampWithinANameIsTheClock) {
  for (const std::string sep : {"\"sep=,\"\n", ""}) {
    const CsvSeries s =
        parse_emg_table(sep +
                            "S_68B7_Timestamp_Unix_CAL,S_68B7_EMG_CH1_CAL,S_68B7_Gyro_X_CAL,\n"
                            "ms,mV,deg/s,\n1606300000000,1,2,\n1606300000002,3,4,\n1606300000004,5,6,\n",
                        "a.csv");
    ASSERT_EQ(s.data.channel_count(), 2) << sep;
    EXPECT_EQ(s.data.channels()[0], (Channel{"S_68B7_EMG_CH1_CAL", Unit::volt}));
    EXPECT_NEAR(s.data.time_s()[1] - s.data.time_s()[0], 0.002, 1e-6);  // round-off of 1.6e9 s
    EXPECT_DOUBLE_EQ(s.data.values()(1, 0), 3e-3);
  }
}

TEST(EmgTable, AClockOfThirteenDigitsCountsMilliseconds) {
  for (const auto& [digits, seconds] :
       {std::pair("1606300000", 1.0), std::pair("1606300000000", 1e-3), std::pair("1606300000000000", 1e-6)}) {
    const std::string begin = std::string(digits).substr(0, std::string(digits).size() - 1);
    const CsvSeries s =
        parse_emg_table("timestamp,EMG [mV]\n" + begin + "1,1\n" + begin + "2,2\n" + begin + "3,3\n", "a.csv");
    EXPECT_NEAR(s.data.time_s()[2] - s.data.time_s()[0], 2.0 * seconds, 1e-6) << digits;
    EXPECT_EQ(s.repairs.size(), seconds < 1.0 ? 1U : 0U);
  }
}

TEST(EmgTable, TimesOfTheDayAreSeconds) {
  for (const std::string day : {"", "2026-05-01T", "2026-05-01 "}) {
    const CsvSeries s = parse_emg_table(
        "Time,EMG [mV]\n" + day + "10:02:59.500,1\n" + day + "10:03:00.000,2\n" + day + "10:03:00.500,3\n", "a.csv");
    ASSERT_EQ(s.data.sample_count(), 3) << day;
    EXPECT_NEAR(s.data.time_s()[2] - s.data.time_s()[1], 0.5, 1e-6);
    if (day.empty()) {
      EXPECT_DOUBLE_EQ(s.data.time_s()[1], 36180.0);
    }
    EXPECT_EQ(s.repairs.size(), 1U);
  }
}

TEST(EmgTable, AColumnOfTextsAndACountWithoutANameAreLeftOutWithANote) {
  const CsvSeries s =
      parse_emg_table(",time,phase,EMG [mV],note\n0,0.0,rest,1,\n1,0.1,rest,2,\n2,0.2,effort,3,\n", "a.csv");
  ASSERT_EQ(s.data.channel_count(), 1);  // a note that no row has is no channel
  EXPECT_EQ(s.data.channels()[0].name, "EMG");
  EXPECT_DOUBLE_EQ(s.data.values()(2, 0), 3e-3);
  EXPECT_EQ(std::ranges::count_if(s.repairs, [](const Repair& r) { return r.message.ends_with("rows), phase"); }), 1);
  // A text in one row alone is a damaged number.
  EXPECT_THROW((void)parse_emg_table("time,EMG\n0,1\n0.1,x\n0.2,3\n", "a.csv"), ReadError);
}

TEST(EmgTable, WordsOfEveryProgramForNoNumberAreGaps) {
  for (const char* word : {"", "NaN", "-", "--", "NA", "#N/A", "null", "None", "-1.#IND", "1.#QNAN", "-nan(ind)",
                           "#NUM!", "#DIV/0!", "#WERT!", "****", ".", "?", "OVR", "missing"}) {
    const CsvSeries s = parse_emg_table(fmt::format("time,EMG [mV],b\n0,1,2\n1,{},3\n2,4,5\n", word), "a.csv");
    EXPECT_TRUE(std::isnan(s.data.values()(1, 0))) << word;
    EXPECT_DOUBLE_EQ(s.data.values()(1, 1), 3.0) << word;
    EXPECT_EQ(s.repairs.size(), 1U) << word;
  }
  EXPECT_THROW((void)parse_emg_table("time,EMG\n0,1\n1,4*\n2,4\n", "a.csv"), ReadError);
}

TEST(EmgTable, WordsBehindTheSamplesAndARepeatedHeaderAreNoRows) {
  const std::string head = "time,EMG [mV]\n", rows = "0,1\n1,2\n2,3\n";
  for (const std::string foot : {"Sum,6\n", "\nMean,2\nSD,1\n", "End of file\n", "Max,,\n"}) {
    const CsvSeries s = parse_emg_table(head + rows + foot, "a.csv");
    EXPECT_EQ(s.data.sample_count(), 3) << foot;
    EXPECT_EQ(s.repairs.size(), 1U) << foot;
  }
  const CsvSeries twice = parse_emg_table(head + rows + head + "3,4\n4,5\n", "a.csv");
  EXPECT_EQ(twice.data.sample_count(), 5);
  ASSERT_EQ(twice.repairs.size(), 1U);
  EXPECT_EQ(twice.repairs[0].line, 5U);
  // A word in the middle of the samples is a damaged row.
  EXPECT_THROW((void)parse_emg_table(head + rows + "Sum,6\n3,4\n", "a.csv"), ReadError);
}

TEST(EmgTable, QuotedCellsMayHoldDecimalCommas) {
  const CsvSeries s = parse_emg_table("time,EMG [mV]\n\"0,000\",\"1,5\"\n\"0,001\",\"-2,25\"\n", "a.csv");
  EXPECT_DOUBLE_EQ(s.data.time_s()[1], 0.001);
  EXPECT_DOUBLE_EQ(s.data.values()(1, 0), -2.25e-3);
  // "1,234" may be 1234 here.
  for (const char* rows : {"0,\"1,234\"\n1,\"12,345\"\n", "0,\"1,234.5\"\n1,\"12,345.5\"\n"})
    EXPECT_THROW((void)parse_emg_table("time,EMG [uV]\n" + std::string(rows), "a.csv"), ReadError) << rows;
}

TEST(EmgTable, NamesMayGoOverTwoLinesOrStandBehindAMarkOfComments) {
  const std::string names = "\"Time\n[s]\",\"EMG BIC\n[mV]\"\n";
  const CsvSeries lines = parse_emg_table(names + "0,1\n0.5,2\n", "a.csv");
  EXPECT_EQ(lines.data.channels()[0].name, "EMG BIC");
  EXPECT_DOUBLE_EQ(lines.data.values()(1, 0), 2e-3);
  try {
    (void)parse_emg_table(names + "0,1\n0.5,x\n1,3\n", "a.csv");
    ADD_FAILURE();
  } catch (const ReadError& error) {
    EXPECT_EQ(error.line(), 5U);
  }
  // A quote that nothing closes belongs to a name.
  EXPECT_EQ(parse_emg_table("Cuff 5\"\nSampling rate: 10 Hz\nA,B\n1,2\n3,4\n", "a.csv").data.channel_count(), 2);
  for (const std::string head : {"# time,EMG [mV]\n", "# a remark\n# time,EMG [mV]\n", "%time,EMG [mV]\n"}) {
    const CsvSeries marked = parse_emg_table(head + "0,1\n0.5,2\n", "a.csv");
    EXPECT_EQ(marked.data.channels()[0], (Channel{"EMG", Unit::volt})) << head;
  }
}

TEST(EmgTable, ATextInEveryRowHidesNoTableBelowALinesOfAHeader) {
  const CsvSeries s = parse_emg_table(
      "Date;01.05.2026\nRep;1\nTime [s];Torque [Nm];Side;Clock\n0,00;1,5;left;2026-05-01 10:02:03.5\n"
      "0,01;2,5;left;2026-05-01 10:02:03.6\n0,02;3;right;2026-05-01 10:02:03.7\n",
      "a.csv");
  EXPECT_EQ(s.data.channels(), (std::vector<Channel>{{"Torque", Unit::newton_meter}}));
  EXPECT_DOUBLE_EQ(s.data.values()(1, 0), 2.5);
  EXPECT_DOUBLE_EQ(s.data.time_s()[2], 0.02);
  EXPECT_EQ(std::ranges::count_if(s.repairs, [](const Repair& r) { return r.message.ends_with("Side, Clock"); }), 1);
}

TEST(EmgTable, AUnitBehindABlankBelongsToTheNameBeforeIt) {
  const CsvSeries s = parse_emg_table("Time (sec) Torque (Nm) Angle (deg)\n0 1 45\n0.01 2 46\n", "a.txt");
  EXPECT_EQ(s.data.channels()[0], (Channel{"Torque", Unit::newton_meter}));
  EXPECT_DOUBLE_EQ(s.data.values()(1, 1), 46 * kDegree);
  EXPECT_EQ(parse_emg_table("# time emg\n0 1\n1 2\n", "a.txt").data.channels()[0].name, "emg");
}

TEST(EmgTable, ZerosBehindTheEndOfAChannelAreNoSamples) {
  // Programs fill the columns of a slower sensor with zeros, its times too.
  const CsvSeries s = parse_emg_table(
      "X[s],\"EMG 1 [V]\",X[s],\"ACC.X 1 [g]\"\n0,1,0,7\n0.001,2,0.002,8\n0.002,3,0,0\n0.003,4,0,0\n", "a.csv");
  EXPECT_EQ(s.data.sample_count(), 4);
  ASSERT_EQ(s.other_clocks.size(), 1U);
  EXPECT_EQ(s.other_clocks[0].data.sample_count(), 2);
  EXPECT_THROW(
      (void)parse_emg_table("X[s],A [V],X[s],B [V]\n0,1,0,7\n0.001,2,0.002,8\n0.002,3,0,9\n0.003,4,0,0\n", "a.csv"),
      ReadError);
}

TEST(EmgTable, AColumnWithoutANameIsLeftOutWhereItIsEmptyElseNamed) {
  const CsvSeries empty = parse_emg_table("time,EMG [mV],,b\n0,1,,2\n1,3,,4\n", "a.csv");
  EXPECT_EQ(empty.data.channel_count(), 2);
  EXPECT_DOUBLE_EQ(empty.data.column("b")[1], 4.0);
  const CsvSeries filled = parse_emg_table("time,EMG [mV],,b\n0,1,,2\n1,3,7,4\n", "a.csv");
  ASSERT_EQ(filled.data.channel_count(), 3);
  EXPECT_DOUBLE_EQ(filled.data.values()(1, 1), 7.0);
  // A named column that is empty stays a gap.
  EXPECT_EQ(parse_emg_table("time,a,b\n0,,2\n1,,4\n", "a.csv").data.channel_count(), 2);
  EXPECT_THROW((void)parse_emg_table("time,a,a\n0,1,2\n1,3,4\n", "a.csv"), ReadError);
}

TEST(EmgTable, NamesBetweenBlanksStandAboveRowsBetweenTabs) {
  const CsvSeries s = parse_emg_table(
      "[Force Data]\nNumberOfForcePlates=1\nSampleRate=150.0\n#Sample FX1 FY1 FZ1\n1\t3\t-2\t400\n2\t4\t-2\t401\n",
      "cortex.txt");
  ASSERT_EQ(s.data.channel_count(), 3);
  EXPECT_EQ(s.data.channels()[2].name, "FZ1");
  EXPECT_EQ(s.data.values()(1, 2), 401.0);
  EXPECT_NEAR(s.data.mean_rate_hz(), 150.0, 1e-9);
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
    static_cast<void>(parse_emg_table("Frequency;1000\ntime;a\ns;mV\n0;1\n0.1;2\n0.2;x\n0.3;4\n", "a.csv"));
    FAIL();
  } catch (const ReadError& error) {
    EXPECT_EQ(error.line(), 6U);
  }
  EXPECT_THROW(static_cast<void>(parse_emg_table("no table at all\n", "a.csv")), ReadError);
  EXPECT_THROW(static_cast<void>(parse_emg_table("X [s],a\n0,1\n0,2\n0,3\n", "a.csv")), ReadError);
}

TEST(EmgTable, CommasBetweenCellsAndInsideNumbersAreRefused) {
  const std::string head = "Sampling rate: 2000 Hz\nVL [uV],BF [uV]\n";
  EXPECT_THROW((void)parse_emg_table(head + "-88,9,15,4\n-87,1,14,2\n", "a.csv"), ReadError);
  EXPECT_EQ(parse_emg_table(head + "-88,15\n-87,14\n", "a.csv").data.channel_count(), 2);
}

TEST(EmgTable, AChannelBeforeTheFirstOfTwoTimeColumnsHasItsClock) {
  // Found by fuzzing: such a channel had neither a clock nor a rate.
  const CsvSeries s =
      parse_emg_table("A [mV],X [s],\"EMG 1 [mV]\",X [s],\"EMG 2 [mV]\"\n7,0,1,0,2\n8,0.1,3,0.1,4\n", "a.csv");
  EXPECT_EQ(s.data.channel_count(), 3);
  EXPECT_DOUBLE_EQ(s.data.column("A")[1], 8e-3);
  EXPECT_DOUBLE_EQ(s.data.time_s()[1], 0.1);
}

TEST(EmgTable, NamesStandAboveTheFirstRowsOfNumbersAndUnitsBetween) {
  const CsvSeries s =
      parse_emg_table("Some lab\nSampling rate: 1000 Hz\n\nFrame,E1,E2\n,mV,uV\n1,0.5,7\n2,0.25,8\n", "a.csv");
  ASSERT_EQ(s.data.channel_count(), 2);
  EXPECT_DOUBLE_EQ(s.data.values()(1, 0), 0.25e-3);
  EXPECT_DOUBLE_EQ(s.data.values()(1, 1), 8e-6);
  EXPECT_DOUBLE_EQ(s.data.time_s()[1], 0.001);
}

}  // namespace
}  // namespace myoid::recording
