#include "myoid/recording/tables/channel_labels.h"

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/recording/makers/emg_table.h"
#include "myoid/recording/tables/csv_reader.h"

#include "tests/support/repair_lines.h"

namespace myoid::recording {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> names_of(const CsvSeries& s) {
  std::vector<std::string> names;
  for (const Channel& channel : s.data.channels()) names.push_back(channel.name);
  return names;
}

/// A table with these names and three rows; column c holds c + row / 8.
CsvSeries table(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t c = 0; c < names.size(); ++c) text += (c > 0 ? "," : "") + names[c];
  for (int row = 0; row < 3; ++row) {
    text += "\n";
    for (std::size_t c = 0; c < names.size(); ++c)
      text += (c > 0 ? "," : "") + std::to_string(static_cast<double>(c) + row / 8.0);
  }
  return parse_emg_table(text + "\n", "a.csv");
}

TEST(ChannelLabels, AnAxisIsNoClock) {
  for (const char* time : {"time", "Time (s)", "t"}) {
    const CsvSeries s = table({time, "x", "y", "z"});
    EXPECT_THAT(names_of(s), ElementsAre("x", "y", "z")) << time;
    EXPECT_TRUE(s.other_clocks.empty());
    EXPECT_DOUBLE_EQ(s.data.time_s()[2], 0.25);
    EXPECT_DOUBLE_EQ(s.data.values()(2, 0), 1.25);
  }
  EXPECT_THAT(names_of(table({"time [s]", "Fz [N]", "X", "Y"})), ElementsAre("Fz", "X", "Y"));
}

TEST(ChannelLabels, ATableHasOneClockAndOtherTimesAreChannels) {
  for (const char* other : {"timestamp", "temps", "Zeit", "T"}) {
    const CsvSeries s = table({"time", "EMG [mV]", other, "event [N]"});
    EXPECT_THAT(names_of(s), ElementsAre("EMG", other, "event")) << other;
    EXPECT_DOUBLE_EQ(s.data.values()(2, 1), 2.25);
  }
  // A torque called T does not take the place of the clock behind it.
  EXPECT_THAT(names_of(table({"T", "time", "a"})), ElementsAre("T", "a"));
  const CsvSeries noted = parse_emg_table("a table\nZeit,EMG [mV],timestamp\n0,1,7\n1,2,8\n2,3,9\n", "a.csv");
  EXPECT_THAT(test::repair_lines(noted.repairs), HasSubstr("since the clock is 'Zeit': timestamp"));
}

TEST(ChannelLabels, AClockWhoseNameWasMadeUniqueIsThatOfTheChannelsBehindIt) {
  for (const char* again : {"time", "time2", "time.1", "time_2", "time 2"}) {
    const std::string head = std::string("time,a,") + again + ",b\n";
    const CsvSeries s = parse_emg_table(head + "0,1,0,5\n0.1,2,0.11,6\n0.2,3,0.22,7\n", "a.csv");
    EXPECT_THAT(names_of(s), ElementsAre("a")) << again;
    ASSERT_EQ(s.other_clocks.size(), 1U) << again;
    EXPECT_DOUBLE_EQ(s.other_clocks[0].data.time_s()[2], 0.22) << again;
  }
  const CsvSeries beside = parse_emg_table("time,time2,a\n0,7,1\n0.1,8,2\n0.2,9,3\n", "a.csv");
  EXPECT_THAT(names_of(beside), ElementsAre("time2", "a"));
  EXPECT_EQ(beside.repairs.size(), 1U);
  EXPECT_THAT(names_of(table({"t", "t1", "t2"})), ElementsAre("t1", "t2"));
}

TEST(ChannelLabels, NumbersUnderTheNamesOfEventsAndMarkersAreChannels) {
  EXPECT_THAT(names_of(table({"time", "marker [mm]", "event"})), ElementsAre("marker", "event"));
  // "Index" that counts nothing is a finger.
  EXPECT_THAT(names_of(table({"time", "thumb", "index", "Sample"})), ElementsAre("thumb", "index", "Sample"));
  const CsvSeries counted = parse_emg_table("Frame;Frame;time;a\n1;7;0;1\n2;7;1;2\n3;7;2;3\n", "a.csv");
  EXPECT_THAT(names_of(counted), ElementsAre("a"));
  EXPECT_THAT(test::repair_lines(counted.repairs), HasSubstr("left out: Frame"));
  const CsvSeries texts = parse_emg_table("time,event,a\n0,,1\n1,go,2\n2,,3\n", "a.csv");
  EXPECT_THAT(names_of(texts), ElementsAre("a"));
  ASSERT_EQ(texts.events.size(), 1U);
}

TEST(ChannelLabels, AnIndexInBracketsIsNoUnit) {
  EXPECT_THAT(names_of(table({"time", "C7[0]", "C7[1]", "C7[2]"})), ElementsAre("C7[0]", "C7[1]", "C7[2]"));
  EXPECT_THAT(names_of(table({"time", "EMG[1]"})), ElementsAre("EMG[1]"));
  EXPECT_THAT(names_of(table({"time", "EMG [1]", "EMG [2]"})), ElementsAre("EMG [1]", "EMG [2]"));
  EXPECT_THAT(names_of(table({"time", "BIC [1]", "TRI [1]"})), ElementsAre("BIC", "TRI"));  // the unit of a ratio
}

TEST(ChannelLabels, AUnitMeansTheSameInEveryTable) {
  // g is the acceleration of gravity, 9.80665 m/s^2, in a plain table, in one with lines above it, and by itself.
  const std::string rows = "time,ACC X [g],ACC Y (G)\n0,1,2\n0.01,1,2\n0.02,1,2\n";
  for (const CsvSeries& s : {parse_emg_table(rows, "a.csv"), parse_csv_series(rows, "a.csv"),
                             parse_emg_table("Sampling rate: 100 Hz\n" + rows, "a.csv")}) {
    EXPECT_EQ(s.data.channels()[0].unit, Unit::meter_per_second2);
    EXPECT_DOUBLE_EQ(s.data.values()(0, 0), 9.80665);
    EXPECT_DOUBLE_EQ(s.data.values()(0, 1), 2 * 9.80665);
  }
}

TEST(ChannelLabels, UnitsOfOtherCountriesAndMachinesAreRead) {
  constexpr double kFootPound_nm = 1.3558179483314004;  // foot (0.3048 m) times pound-force (4.4482216152605 N)
  for (const auto& [symbol, unit, to_si] :
       {std::tuple("us", Unit::second, 1e-6), std::tuple("µs", Unit::second, 1e-6),
        std::tuple("milliseconds", Unit::second, 1e-3), std::tuple("º", Unit::radian, kDegree),
        std::tuple("Deg.", Unit::radian, kDegree), std::tuple("°/sec", Unit::radian_per_second, kDegree),
        std::tuple("deg s-1", Unit::radian_per_second, kDegree),
        std::tuple("rpm", Unit::radian_per_second, 6 * kDegree), std::tuple("KG-M", Unit::newton_meter, 9.80665),
        std::tuple("kg·cm", Unit::newton_meter, 0.0980665), std::tuple("lb·ft", Unit::newton_meter, kFootPound_nm),
        std::tuple("ft-lbf", Unit::newton_meter, kFootPound_nm),
        std::tuple("foot-pounds", Unit::newton_meter, kFootPound_nm), std::tuple("kp·m", Unit::newton_meter, 9.80665),
        std::tuple("mVolt", Unit::volt, 1e-3), std::tuple("uVolts", Unit::volt, 1e-6),
        std::tuple("um", Unit::meter, 1e-6)}) {
    const auto read = unit_in_cell(symbol);
    ASSERT_TRUE(read) << symbol;
    EXPECT_EQ(read->unit, unit) << symbol;
    EXPECT_NEAR(read->to_si, to_si, 1e-12 * to_si) << symbol;
  }
}

TEST(ChannelLabels, AUnitStandsBehindASlashAWordOrAnUnderscoreToo) {
  const CsvSeries s = table({"Zeit in ms", "EMG/mV", "Torque/Nm", "Angle in deg", "Fz_uV", "Moment Nm/kg", "V/s"});
  EXPECT_THAT(names_of(s), ElementsAre("EMG", "Torque", "Angle", "Fz_uV", "Moment Nm/kg", "V/s"));
  EXPECT_DOUBLE_EQ(s.data.time_s()[2], 0.25e-3);
  EXPECT_EQ(s.data.channels()[1].unit, Unit::newton_meter);
  EXPECT_DOUBLE_EQ(s.data.values()(0, 2), 3 * kDegree);
  EXPECT_DOUBLE_EQ(s.data.values()(0, 3), 4e-6);
  EXPECT_EQ(s.has_unit, (std::vector<bool>{true, true, true, true, false, false}));
  // Names of muscles that end as a unit does.
  const CsvSeries muscles = table({"time", "flexor_carpi_rad", "vas_m", "GAS_l", "L/R"});
  EXPECT_EQ(muscles.has_unit, std::vector<bool>(4, false));
}

TEST(ChannelLabels, AnIndexBesideAUnitLeavesTheUnit) {
  const CsvSeries s = table({"Time", "MULTI-IN 1(1)[mV]", "MULTI-IN 1(2)[mV]"});
  EXPECT_THAT(names_of(s), ElementsAre("MULTI-IN 1(1)", "MULTI-IN 1(2)"));
  EXPECT_DOUBLE_EQ(s.data.values()(0, 0), 1e-3);
}

TEST(ChannelLabels, AFirstColumnInAUnitOfTimeIsTheClock) {
  for (const auto& [name, to_s] :
       {std::pair("Elapsed Time (s)", 1.0), std::pair("Time (milliseconds)", 1e-3), std::pair("Timestamp [us]", 1e-6),
        std::pair("Time/s", 1.0), std::pair("t_ms", 1e-3), std::pair("time_sec", 1.0), std::pair("Time [min]", 60.0)}) {
    const CsvSeries s = table({name, "EMG [mV]"});
    EXPECT_THAT(names_of(s), ElementsAre("EMG")) << name;
    EXPECT_DOUBLE_EQ(s.data.time_s()[2], 0.25 * to_s) << name;
  }
}

TEST(ChannelLabels, PeriodsAreReadInSeconds) {
  EXPECT_DOUBLE_EQ(*period_in_cell("0.000794 s"), 0.000794);
  EXPECT_DOUBLE_EQ(*period_in_cell("0,5 ms"), 0.0005);
  EXPECT_FALSE(period_in_cell("1259 Hz"));
  EXPECT_FALSE(period_in_cell("0.5"));
}

}  // namespace
}  // namespace myoid::recording
