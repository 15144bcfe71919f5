#include "myoid/recording/makers/discover_events.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/makers/emg_table.h"

namespace myoid::recording {
namespace {

/// A text of Discover 2.1: two clocks, rows of rates and of periods. EMG is 0, 1, 2, ... mV, the acceleration 0.5 g.
std::string discover(char between,
                     bool commas,
                     const std::string& event_names,
                     const std::vector<std::string>& events) {
  const std::string s = std::string(1, between) + (between == ',' ? " " : "");
  const auto number = [&](double value) {
    std::string text = std::to_string(value);
    if (commas) text.replace(text.find('.'), 1, ",");
    return text;
  };
  std::string text = "Application:" + s + "Trigno Discover (2.1.0.7)\nDate/Time:" + s + "2026/01/15 15:50:51\n";
  text += "Collection Length (seconds):" + s + "1\nAvanti Sensor 1 (75923)" + s + s + s + "\nsensor mode: 65" + s + s +
          s + "\n";
  text += "EMG 1 Time Series (s)" + s + "EMG 1 (mV)" + s + "ACC X Time Series (s)" + s + "ACC X (G)\n";
  text += s + "1000.0000 Hz" + s + s + "250.0000 Hz\n";
  text += s + number(0.001) + " s" + s + s + number(0.004) + " s" + event_names + "\n";
  for (int i = 0; i < 12; ++i) {
    text += number(0.001 * i) + s + number(i);
    text += i < 3 ? s + number(0.004 * i) + s + number(0.5) : s + s;
    if (static_cast<std::size_t>(i) < events.size()) text += events[static_cast<std::size_t>(i)];
    text += "\n";
  }
  return text;
}

void expect_the_channels(const CsvSeries& file) {
  ASSERT_EQ(file.data.channel_count(), 1);
  EXPECT_EQ(file.data.channels()[0], (Channel{"EMG 1", Unit::volt}));
  ASSERT_EQ(file.data.sample_count(), 12);
  EXPECT_NEAR(file.data.values()(7, 0), 7e-3, 1e-15);
  EXPECT_NEAR(file.data.time_s()[7], 0.007, 1e-15);
  ASSERT_EQ(file.other_clocks.size(), 1U);
  EXPECT_EQ(file.other_clocks[0].data.sample_count(), 3);
  EXPECT_NEAR(file.other_clocks[0].data.values()(2, 0), 0.5 * 9.80665, 1e-12);
}

TEST(Discover, RowsOfRatesAndPeriodsAreNoNames) {
  expect_the_channels(parse_emg_table(discover(',', false, "", {}), "a.csv"));
  expect_the_channels(parse_emg_table(discover(';', true, "", {}), "a.csv"));
}

TEST(Discover, EventsBesideTheFirstRowsAreEvents) {
  const CsvSeries file =
      parse_emg_table(discover(',', false, ", , Type, Name, Label, Time (s)",
                               {", , General, Marker 1, go, 0.0025", ", , General, Marker 2, , 0.0075"}),
                      "a.csv");
  expect_the_channels(file);
  ASSERT_EQ(file.events.size(), 2U);
  EXPECT_EQ(file.events[0].label, "go");
  EXPECT_EQ(file.events[1].label, "Marker 2");
  EXPECT_DOUBLE_EQ(file.events[1].time_s, 0.0075);
  const CsvSeries commas = parse_emg_table(
      discover(';', true, ";Type;Name;Label;Time (s)", {";General;Marker 1;go;0,0025", ";General;Marker 2;;0,0075"}),
      "a.csv");
  expect_the_channels(commas);
  ASSERT_EQ(commas.events.size(), 2U);
  EXPECT_DOUBLE_EQ(commas.events[1].time_s, 0.0075);
}

TEST(Discover, OtherTextsHaveNone) {
  TableText text("time,a\n0,1\n1,2,3\n");
  EXPECT_TRUE(take_discover_events(text).empty());
  EXPECT_EQ(text.lines[2], "1,2,3");
}

}  // namespace
}  // namespace myoid::recording
