// Files as other programs write them, made here by hand after their conventions.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/recording/c3d/c3d_reader.h"
#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/recording/c3d_recording.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/makers/emg_table.h"
#include "myoid/recording/makers/marker_table.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/trc_reader.h"

#include "tests/support/data_folder.h"
#include "tests/support/repair_lines.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/whole_c3d.h"

namespace myoid::recording {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

C3dFile c3d_of(Eigen::Index frames, int points, int channels) {
  C3dFile file;
  file.point_rate_hz = 100.0;
  file.point_unit = "mm";
  for (int m = 0; m < points; ++m) file.point_labels.push_back("M" + std::to_string(m + 1));
  file.points = C3dFile::Rows::Constant(frames, 4 * points, 8.0F);
  for (int m = 0; m < points; ++m) file.points.col(4 * m + 3).setZero();
  if (channels > 0) {
    file.analog = C3dFile::Rows::Constant(frames, channels, 3.0F);
    for (int c = 0; c < channels; ++c) file.channels.push_back({"E" + std::to_string(c + 1), "V", 0.0, 0.5});
  }
  return file;
}

std::vector<std::byte> changed(std::vector<std::byte> bytes, std::size_t word, std::uint16_t value) {
  bytes[2 * (word - 1)] = static_cast<std::byte>(value & 0xFFU);
  bytes[2 * (word - 1) + 1] = static_cast<std::byte>(value >> 8U);
  return bytes;
}

/// The parameter of this name gets another first value, or another name.
std::vector<std::byte> with_parameter(std::vector<std::byte> bytes,
                                      const std::string& name,
                                      const std::string& other_name) {
  for (std::size_t at = 512; at + name.size() + 2 < bytes.size(); ++at) {
    bool here = static_cast<std::size_t>(bytes[at]) == name.size();
    for (std::size_t i = 0; here && i < name.size(); ++i) here = static_cast<char>(bytes[at + 2 + i]) == name[i];
    if (!here) continue;
    for (std::size_t i = 0; i < name.size(); ++i) bytes[at + 2 + i] = static_cast<std::byte>(other_name[i]);
    return bytes;
  }
  ADD_FAILURE() << name << " is not there";
  return bytes;
}

TEST(ForeignC3d, WithoutAnalogChannelsButWithTheirGroup) {
  const C3dFile file = parse_c3d(changed(format_c3d(c3d_of(10, 2, 0)), 10, 0), "f.c3d");
  EXPECT_EQ(file.frame_count(), 10);
  EXPECT_TRUE(file.channels.empty());
}

TEST(ForeignC3d, OnlyAnalogChannelsWithoutARateOfPoints) {
  C3dFile file = c3d_of(50, 0, 3);
  auto bytes = format_c3d(file);
  const C3dFile found = parse_c3d(bytes, "f.c3d");
  EXPECT_EQ(found.analog.rows(), 50);
  // POINT:RATE (the first parameter of that name) and the header's rate are missing: ANALOG:RATE decides.
  bytes = with_parameter(changed(changed(bytes, 11, 0), 12, 0), "RATE", "NONE");
  const C3dFile rated = parse_c3d(bytes, "f.c3d");
  EXPECT_DOUBLE_EQ(rated.analog_rate_hz(), 100.0);
  EXPECT_THAT(test::repair_lines(rated.repairs), HasSubstr("ANALOG:RATE"));
}

TEST(ForeignC3d, TwoStatementsAboutTheClockOutweighOne) {
  for (const int channels : {0, 2}) {
    auto bytes = format_c3d(c3d_of(200, 1, channels));
    // POINT:RATE is the first parameter of that name; its value stands four bytes behind: 200.
    const std::string name = "RATE";
    const auto at = std::search(bytes.begin() + 512, bytes.end(), name.begin(), name.end(),
                                [](std::byte b, char c) { return b == static_cast<std::byte>(c); });
    ASSERT_NE(at, bytes.end());
    at[10] = std::byte{0x48};
    at[11] = std::byte{0x43};
    const C3dFile file = parse_c3d(bytes, "f.c3d");
    EXPECT_DOUBLE_EQ(file.point_rate_hz, channels == 0 ? 200.0 : 100.0);
    ASSERT_EQ(file.repairs.size(), 1U) << test::repair_lines(file.repairs);
    EXPECT_NEAR(file.repairs[0].apart_s, 1.0, 1e-9);
  }
  // Four channels of one sample a frame, as the parameters say, are not two channels of two.
  EXPECT_EQ(parse_c3d(changed(format_c3d(c3d_of(100, 1, 4)), 10, 2), "f.c3d").channels.size(), 4U);
}

TEST(ForeignC3d, MoreThan65535FramesWhateverTheHeaderSays) {
  const C3dFile longest = c3d_of(70000, 1, 0);
  const auto bytes = format_c3d(longest);
  // Programs write the last frame as 65535, modulo 65536, or as 0.
  for (const int last : {65535, 70000 - 65536, 0}) {
    const C3dFile file = parse_c3d(changed(bytes, 5, static_cast<std::uint16_t>(last)), "f.c3d");
    EXPECT_EQ(file.frame_count(), 70000) << last << test::repair_lines(file.repairs);
  }
}

TEST(ForeignC3d, WithoutTheScaleParameterTheHeaderDecides) {
  for (const bool integer : {false, true}) {
    const auto bytes = with_parameter(format_c3d(c3d_of(10, 2, 1), {C3dProcessor::intel, integer}), "SCALE", "SCXLE");
    const C3dFile file = parse_c3d(bytes, "f.c3d");
    EXPECT_EQ(file.integer, integer);
    EXPECT_FLOAT_EQ(file.points(3, 4), 8.0F);
  }
}

TEST(ForeignC3d, WithoutAScaleInTheHeaderTheParameterDecides) {
  const auto bytes = changed(changed(format_c3d(c3d_of(10, 2, 1), {C3dProcessor::intel, true}), 7, 0), 8, 0);
  const C3dFile file = parse_c3d(bytes, "f.c3d");
  EXPECT_FLOAT_EQ(file.points(3, 4), 8.0F);
  EXPECT_THAT(test::repair_lines(file.repairs), HasSubstr("POINT:SCALE"));
}

TEST(ForeignC3d, TheEventGroupCountsBeforeTheHeadersEvents) {
  C3dFile file = c3d_of(10, 1, 0);
  file.events = {{0.03, "Foot Strike", "Left", "S"}};
  auto bytes = format_c3d(file);
  bytes = changed(changed(bytes, 150, 12345), 151, 1);  // one event at 0 s in the header, too
  const C3dFile found = parse_c3d(bytes, "f.c3d");
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.events[0].label, "Foot Strike");
  EXPECT_NEAR(found.events[0].time_s, 0.03, 1e-7);
}

TEST(ForeignC3d, ThreeHundredChannelsHaveTheirNamesAndUnits) {
  const test::TemporaryFolder folder;
  write_c3d(folder / "f.c3d", c3d_of(4, 1, 300));
  const Recording file = read_recording(folder / "f.c3d");
  ASSERT_EQ(file.analog.channel_count(), 300);
  EXPECT_EQ(file.analog.channels()[299], (Channel{"E300", Unit::volt}));
  EXPECT_DOUBLE_EQ(file.analog.series().values()(3, 299), 1.5);
}

constexpr const char* kTrcHead =
    "PathFileType\t4\t(X/Y/Z)\tf.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\t"
    "OrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n100\t100\t3\t2\tmm\t100\t1\t3\n";

TEST(ForeignTrc, BlankCellsAtTheEndOfARowAreGaps) {
  const std::string text = std::string(kTrcHead) +
                           "Frame#\tTime\tA\t\t\tB\t\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n"
                           "1\t0.00\t1\t2\t3\t4\t5\t6\t\n2\t0.01\t1\t2\t3\t\t\t\t\t\n"
                           "3\t0.02\t1\t2\t3\t4\t5\t6\t\n";
  const MarkerFile file = parse_trc(text, "f.trc");
  EXPECT_EQ(file.markers.frame_count(), 3);
  EXPECT_TRUE(file.markers.missing(1, 1));
  EXPECT_DOUBLE_EQ(file.markers.position(2, 1).z(), 0.006);
}

TEST(ForeignTrc, WithAByteOrderMarkAndWindowsLineEnds) {
  std::string text = "\xEF\xBB\xBF" + std::string(kTrcHead) +
                     "Frame#\tTime\tA\t\t\tB\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n"
                     "1\t0\t1\t2\t3\t4\t5\t6\n2\t0.01\t1\t2\t3\t4\t5\t6\n3\t0.02\t1\t2\t3\t4\t5\t6\n";
  std::string windows;
  for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
  const MarkerFile file = parse_trc(windows, "f.trc");
  EXPECT_THAT(file.markers.names, ElementsAre("A", "B"));
  EXPECT_EQ(file.markers.frame_count(), 3);
}

TEST(ForeignTrc, WithoutTheColumnOfFramesItIsRefusedWithTheLine) {
  const std::string text = std::string(kTrcHead) +
                           "Time\tA\t\t\tB\t\t\n\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n"
                           "0\t1\t2\t3\t4\t5\t6\n0.01\t1\t2\t3\t4\t5\t6\n0.02\t1\t2\t3\t4\t5\t6\n";
  try {
    static_cast<void>(parse_trc(text, "f.trc"));
    ADD_FAILURE() << "read";
  } catch (const ReadError& error) {
    EXPECT_THAT(std::string(error.what()), HasSubstr("f.trc:4: "));
  }
}

TEST(ForeignMarkerTable, MotivesMarkersAreReadAndItsRigidBodiesLeftOut) {
  const std::string text =
      "Format Version,1.23,Take Name,T,Capture Frame Rate,100.000000,Export Frame Rate,100.000000,"
      "Total Exported Frames,3,Rotation Type,Quaternion,Length Units,Meters,Coordinate "
      "Space,Global\n"
      "\n"
      ",,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,"
      "Rigid Body Marker,Rigid Body Marker,Rigid Body Marker,Rigid Body "
      "Marker,Marker,Marker,Marker,"
      "Marker,Marker,Marker\n"
      ",,Hand,Hand,Hand,Hand,Hand,Hand,Hand,Hand,Hand:M1,Hand:M1,Hand:M1,Hand:M1,Hand:M1,Hand:M1,"
      "Hand:M1,ELB,ELB,ELB\n"
      ",,1,1,1,1,1,1,1,1,2,2,2,2,3,3,3,4,4,4\n"
      ",,Rotation,Rotation,Rotation,Rotation,Position,Position,Position,Mean Marker Error,Position,"
      "Position,Position,Marker Quality,Position,Position,Position,Position,Position,Position\n"
      "Frame,Time (Seconds),X,Y,Z,W,X,Y,Z,,X,Y,Z,,X,Y,Z,X,Y,Z\n"
      "0,0.000000,0,0,0,1,9,9,9,0.1,8,8,8,1,0.1,1.2,0.3,0.4,0.5,0.6\n"
      "1,0.010000,0,0,0,1,9,9,9,0.1,8,8,8,1,0.11,1.21,0.31,,,\n"
      "2,0.020000,0,0,0,1,9,9,9,0.1,8,8,8,1,0.12,1.22,0.32,0.42,0.52,0.62\n";
  ASSERT_TRUE(is_marker_table(text));
  const MarkerFile file = parse_marker_table(text, "take.csv");
  EXPECT_THAT(file.markers.names, ElementsAre("Hand:M1", "ELB"));
  EXPECT_DOUBLE_EQ(file.markers.position(2, 0).y(), 1.22);
  EXPECT_DOUBLE_EQ(file.markers.position(0, 1).x(), 0.4);
  EXPECT_TRUE(file.markers.missing(1, 1));
  EXPECT_DOUBLE_EQ(file.markers.time_s[2], 0.02);
  std::string millimeters = text;
  millimeters.replace(millimeters.find("Meters"), 6, "Millimeters");
  EXPECT_DOUBLE_EQ(parse_marker_table(millimeters, "take.csv").markers.position(0, 0).y(), 0.0012);
}

TEST(ForeignEmg, ATableInUtf16WithSemicolonsAndDecimalCommasIsRead) {
  const test::TemporaryFolder folder;
  const std::string text =
      "Name;Trial\r\nFrequency;1000\r\n\r\ntime;LT BIC\r\ns;uV\r\n"
      "0,000;1,5\r\n0,001;-2,5\r\n0,002;3,5\r\n";
  std::string wide = "\xFF\xFE";
  for (const char c : text) wide += std::string{c, '\0'};
  write_file(folder / "n.csv", wide);
  const EmgFile file = read_emg(folder / "n.csv", "", false);
  ASSERT_EQ(file.data.sample_count(), 3);
  EXPECT_DOUBLE_EQ(file.data.values()(1, 0), -2.5e-6);
}

TEST(ForeignEmg, DelsysColumnsWithTheirOwnClocksAreOne) {
  const std::string text =
      "X [s],\"Trigno 1: EMG 1 [V]\",X [s],\"Trigno 1: ACC X [g]\",X [s],\"Trigno 2: EMG 2 [V]\"\n"
      "0,0.001,0,1,0,0.004\n0.0005,0.002,0.0067,1,0.0005,0.005\n0.001,0.003,,,0.001,0.006\n";
  const test::TemporaryFolder folder;
  write_file(folder / "d.csv", text);
  const EmgFile file = read_emg(folder / "d.csv", "", false);
  ASSERT_EQ(file.data.channel_count(), 2);
  ASSERT_EQ(file.data.sample_count(), 3);
  EXPECT_DOUBLE_EQ(file.data.values()(2, 1), 0.006);
  EXPECT_NEAR(file.data.mean_rate_hz(), 2000.0, 1e-6);
}

TEST(ForeignEmg, ASensorWithoutAFixedRateBesideOthersHasItsOwnTimes) {
  // A heart-rate strap has the rate -1 Hz in the row of rates.
  const CsvSeries s = parse_emg_table(
      "Application:, Discover\nEMG 01 (5), , Strap  (6)\nsensor mode: 45, , sensor mode: 0\n"
      "EMG 1 Time Series (s), EMG 1 (mV), Heart Rate Time Series (s), Heart Rate (BPM)\n"
      ", 2000 Hz, , -1 Hz\n0, -0.25, 0.125, 71\n0.0005, 0.5, 1.125, 72\n0.001, 0.75, 2.25, 74\n",
      "a.csv");
  EXPECT_EQ(s.data.channels()[0], (Channel{"EMG 1", Unit::volt}));
  EXPECT_NEAR(s.data.mean_rate_hz(), 2000.0, 1e-6);
  EXPECT_DOUBLE_EQ(s.data.values()(2, 0), 0.75e-3);
  ASSERT_EQ(s.other_clocks.size(), 1U);
  EXPECT_EQ(s.other_clocks[0].data.time_s(), Eigen::Vector3d(0.125, 1.125, 2.25));
}

TEST(ForeignEmg, ATableOfLabviewHasItsUnitsInALineAboveTheNames) {
  const CsvSeries s = parse_emg_table(
      "LabVIEW Measurement\t\nSeparator\tTab\nDate\t2024/05/06\nTime\t16:15:51.123\n***End_of_Header***\t\n\t\n"
      "Channels\t2\t\t\nSamples\t3\t3\t\nDate\t2024/05/06\t2024/05/06\t\nTime\t16:15:51.12\t16:15:51.12\t\n"
      "Y_Unit_Label\tVolts\tNm\t\nX_Dimension\tTime\tTime\t\nX0\t0.0E+0\t0.0E+0\t\nDelta_X\t0.002\t0.002\t\n"
      "***End_of_Header***\t\t\t\nX_Value\tBiceps\tCrank\tComment\n"
      "0.000\t0.25\t10\t\n0.002\t0.5\t11\t\n0.004\t0.75\t12\t\n",
      "a.txt");
  ASSERT_EQ(s.data.channel_count(), 2);
  EXPECT_NEAR(s.data.mean_rate_hz(), 500.0, 1e-9);
  EXPECT_EQ(s.data.channels()[0], (Channel{"Biceps", Unit::volt}));
  EXPECT_EQ(s.data.channels()[1], (Channel{"Crank", Unit::newton_meter}));
  EXPECT_EQ(s.data.values()(2, 1), 12.0);
}

/// Times with three decimals at 2000 Hz: rows share a time, and the frames count on.
std::string rounded_tracks(int lost) {
  std::string text =
      "BTS ASCII format\n\nType:\tEmg tracks\nMeasure unit:\tmV\n\nTracks:\t1\nFrequency:\t2000 Hz\n"
      "Frames:\t40\nStart time:\t0.000\n\n Frame\t  Time\tVoltage:BIC\t\n";
  for (int k = 0; k < 40; ++k)
    if (k != lost) text += fmt::format("{:5}\t{:.3f}\t{}\t\n", k + 1, k / 2000.0, k);
  return text;
}

TEST(ForeignEmg, TimesThatRoundingMadeEqualGiveWayToFramesThatCountOn) {
  const TimeSeries track = parse_emg_table(rounded_tracks(-1), "f.emt").data;
  ASSERT_EQ(track.sample_count(), 40);
  EXPECT_NEAR(track.mean_rate_hz(), 2000.0, 1e-6);
  EXPECT_NEAR(track.time_s()[39], 39 / 2000.0, 1e-12);
  EXPECT_THROW((void)parse_emg_table(rounded_tracks(20), "f.emt"), ReadError);  // a frame is lost
}

/// The clock that holds a channel, and its second sample.
void expect_channel(const Recording& file, const std::string& name, double rate_hz, double second) {
  for (const AnalogChannels* clock : file.clocks()) {
    if (!clock->find(name)) continue;
    const TimeSeries series = clock->select({name});
    EXPECT_NEAR(series.mean_rate_hz(), rate_hz, 1e-6 * rate_hz) << name;
    EXPECT_NEAR(series.values()(1, 0), second, 1e-12) << name;
    return;
  }
  ADD_FAILURE() << "no channel " << name;
}

TEST(ForeignTables, OfDelsysKeepEveryChannelOnItsOwnClock) {
  const auto folder = test::data_folder() / "tables";
  MYOID_REQUIRE_DATA(folder / "discover142.csv");
  const Recording old = read_recording(folder / "discover142.csv");
  EXPECT_EQ(old.clocks().size(), 3U);
  expect_channel(old, "EMG 02 04284 (55240) EMG 1", 34.0 / 0.027, 0.0063275);
  expect_channel(old, "EMG 01 04498 (54717) ACC X", 4.0 / 0.027, 0.0069406);
  expect_channel(old, "Analog I", 120.0 / 0.027, 0.0108283);
  const Recording recent = read_recording(folder / "discover170.csv");
  EXPECT_EQ(recent.clocks().size(), 4U);
  expect_channel(recent, "EMG 01 03558 (88016) EMG 1", 1259.2593, 0.0014532e-3);
  expect_channel(recent, "Quattro 19 01639 (79082) EMG 1", 2222.2222, 0.0563194e-3);
  const Recording works = read_recording(folder / "emgworks.csv");
  EXPECT_EQ(works.clocks().size(), 5U);
  expect_channel(works, "Avanti sensor 1: EMG 1", 3850 / 1.999039, 1.3067e-06);
  expect_channel(works, "Avanti sensor 2: EMG 2", 2517 / 1.998794, 3.9417e-06);
}

TEST(ForeignTables, OfNexusAndNoraxonOpen) {
  const auto folder = test::data_folder() / "tables";
  MYOID_REQUIRE_DATA(folder / "nexus_devices.csv");
  const Recording devices = read_recording(folder / "nexus_devices.csv");
  EXPECT_EQ(devices.analog.channel_count(), 38);
  expect_channel(devices, "EMG1", 2000.0, -2.54e-05);
  const Recording markers = read_recording(folder / "nexus_trajectories.csv");
  EXPECT_EQ(markers.markers.marker_count(), 51);
  EXPECT_NEAR(markers.markers.position(1, 0).x(), 0.0441667, 1e-12);
  const Recording noraxon = read_recording(folder / "noraxon_mr4_activity.csv");
  expect_channel(noraxon, "FLEX.CARP.R LT", 8279.0 / 4.13867, 7.470950902e-6);
  ASSERT_EQ(noraxon.events.size(), 1U);
  EXPECT_EQ(noraxon.events[0].label, "Activity");
}

}  // namespace
}  // namespace myoid::recording
