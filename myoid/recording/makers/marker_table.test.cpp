#include "myoid/recording/makers/marker_table.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/recording/makers/marker_layouts.h"
#include "myoid/recording/recording.h"

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kViconMarkers =
    "Devices\r\n1000\r\n,,EMG - V,\r\nFrame,Sub Frame,BIC,TRI\r\n,,V,V\r\n1,0,0.1,0.2\r\n"
    "1,1,0.3,0.4\r\n1,2,-0.1,0.5\r\n\r\nTrajectories\r\n100\r\n,,P:A,,,P:B,,\r\n"
    "Frame,Sub Frame,X,Y,Z,X,Y,Z\r\n,,mm,mm,mm,mm,mm,mm\r\n1,0,10,20,30,1,2,3\r\n"
    "2,0,11,21,31,,,\r\n3,0,12,22,32,4,5,6\r\n\r\nModel Outputs\r\n100\r\n";
const std::string kQualisysMarkers =
    "NO_OF_FRAMES\t3\nNO_OF_CAMERAS\t8\nNO_OF_MARKERS\t2\nFREQUENCY\t200\nNO_OF_ANALOG\t0\n"
    "ANALOG_FREQUENCY\t0\nDESCRIPTION\t--\nTIME_STAMP\t2026-01-01, 00:00:00.000\t12.5\n"
    "DATA_INCLUDED\t3D\nMARKER_NAMES\tA\tB\nTRAJECTORY_TYPES\tMeasured\tMixed\n";
const std::string kBtsMarkers =
    "BTS ASCII format\n\nType:\tPoint 3D tracks\nMeasure unit:\tm\n\nTracks:\t1\nFrequency:\t100 "
    "Hz\nFrames:\t2\nStart time:\t0.000\n\nFrame\tTime\tA.X\tA.Y\tA.Z\n1\t0.000\t0.1\t0.2\t0.3\n"
    "2\t0.010\t0.4\t0.5\t0.6\n";
const std::string kNdiMarkers =
    "Number of frames:,3,Collection frequency:,100,Units:,cm\n"
    "Frame,M_1 x,M_1 y,M_1 z,M_2 x,M_2 y,M_2 z\n1,1,2,3,4,5,6\n2,1,2,3,,,\n3,1,2,3,4,5,6\n";

TEST(MarkerTable, TrajectoriesOfNexusAreRead) {
  ASSERT_TRUE(is_marker_table(kViconMarkers));
  const MarkerSeries m = parse_marker_table(kViconMarkers, "a.csv").markers;
  EXPECT_THAT(m.names, ElementsAre("A", "B"));  // as of a C3D file: without the subject
  ASSERT_EQ(m.frame_count(), 3);
  EXPECT_DOUBLE_EQ(m.time_s[2], 0.02);
  EXPECT_DOUBLE_EQ(m.position(2, 0).y(), 0.022);
  EXPECT_TRUE(m.missing(1, 1));
}

TEST(MarkerTable, SpeedsBesideTrajectoriesOfNexusAreLeftOut) {
  const MarkerFile file = parse_marker_table(
      "Trajectories\n100\n,,P:A,,,,,,P:B,,\nFrame,Sub Frame,X,Y,Z,X',Y',Z',X,Y,Z\n"
      ",,mm,mm,mm,mm/s,mm/s,mm/s,mm,mm,mm\n1,0,1,2,3,7,7,7,4,5,6\n2,0,1,2,3,7,7,7,4,50,6\n",
      "a.csv");
  EXPECT_THAT(file.markers.names, ElementsAre("A", "B"));
  EXPECT_DOUBLE_EQ(file.markers.position(1, 1).y(), 0.05);
  EXPECT_EQ(file.repairs.size(), 2U);
}

TEST(MarkerTable, APositionBeyondTheEarthIsMissingAndNamed) {
  std::string text = kViconMarkers;
  text.replace(text.find("4,5,6"), 5, "4,1e300,6");
  const MarkerFile file = parse_marker_table(text, "n.csv");
  EXPECT_TRUE(file.markers.missing(2, 1));
  EXPECT_FALSE(file.markers.missing(2, 0));
  EXPECT_THAT(file.repairs.back().message, HasSubstr("1000 km"));
}

TEST(MarkerTable, QualisysRowsAreReadWithAndWithoutFrameAndTime) {
  for (const bool with_time : {false, true}) {
    std::string text = kQualisysMarkers;
    if (with_time) text += "Frame\tTime\tA X\tA Y\tA Z\tB X\tB Y\tB Z\n";
    for (int k = 0; k < 3; ++k) {
      if (with_time) text += std::to_string(k + 1) + "\t" + std::to_string(0.005 * k) + "\t";
      text += k == 1 ? "1.5\t2.5\t3.5\t0.000\t0.000\t0.000\n" : "1.5\t2.5\t3.5\t4\t5\t6\n";
    }
    ASSERT_TRUE(is_marker_table(text));
    const MarkerFile file = parse_marker_table(text, "a.tsv");
    EXPECT_THAT(file.markers.names, ElementsAre("A", "B"));
    EXPECT_NEAR(file.markers.time_s[2], 0.01, 1e-12);
    EXPECT_DOUBLE_EQ(file.markers.position(0, 0).x(), 0.0015);
    EXPECT_TRUE(file.markers.missing(1, 1));
    EXPECT_FALSE(file.markers.missing(2, 1));
    EXPECT_THAT(file.repairs[0].message, HasSubstr("1 positions are 0 0 0"));
  }
}

TEST(MarkerTable, AFrameInWhichQualisysSawNothingKeepsItsPlace) {
  const MarkerSeries m =
      parse_marker_table(kQualisysMarkers + "\t\t\t4\t5\t6\n\t\t\t\t\t\n1\t2\t3\t4\t5\t6\n", "a.tsv").markers;
  ASSERT_EQ(m.frame_count(), 3);
  EXPECT_TRUE(m.missing(0, 0));
  EXPECT_FALSE(m.missing(0, 1));
  EXPECT_TRUE(m.missing(1, 1));
  EXPECT_DOUBLE_EQ(m.position(2, 0).z(), 0.003);
}

TEST(MarkerTable, PointsOfBtsAndNdiAreReadInTheirUnits) {
  EXPECT_DOUBLE_EQ(parse_marker_table(kBtsMarkers, "a.emt").markers.position(1, 0).z(), 0.6);
  const MarkerSeries m = parse_marker_table(kNdiMarkers, "a.csv").markers;
  EXPECT_THAT(m.names, ElementsAre("M_1", "M_2"));
  EXPECT_DOUBLE_EQ(m.position(2, 1).z(), 0.06);
  EXPECT_DOUBLE_EQ(m.time_s[2], 0.02);
  EXPECT_TRUE(m.missing(1, 1));
}

TEST(MarkerLayout, SaysWhereTheRowsAreAndWhatTheHeaderCounts) {
  const auto layout = marker_layout(TableText(kBtsMarkers), "a.emt");
  ASSERT_TRUE(layout);
  EXPECT_THAT(layout->names, ElementsAre("A"));
  EXPECT_EQ(layout->table.first_row, 11U);
  EXPECT_EQ(layout->table.rows_said, 2.0);
  EXPECT_EQ(layout->table.channels_said, 1.0);
  EXPECT_EQ(layout->table.rate_hz, 100.0);
  EXPECT_FALSE(marker_layout(TableText("time,a\n0,1\n"), "a.csv"));
}

TEST(MarkerTable, OtherTablesAreNone) {
  EXPECT_FALSE(is_marker_table("time,Biceps [mV]\n0,1\n0.5,2\n"));
  EXPECT_FALSE(is_marker_table("Frame,Time,Fx,Fy,Fz\n1,0,1,2,3\n2,0.01,1,2,3\n"));
  EXPECT_FALSE(is_marker_table("Frame,ACC x,ACC y,ACC z,EMG [V]\n1,0,0,9.8,1\n2,0,0,9.8,1\n"));
  EXPECT_FALSE(is_marker_table(""));
  EXPECT_THROW((void)parse_marker_table("a,b\n1,2\n", "a.csv"), ReadError);
}

/// Returns the message of the reader for a table in which `from` became `to`.
std::string marker_refusal(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return test::message_of<ReadError>([&] { (void)parse_marker_table(text, "a.csv"); });
}

TEST(MarkerTable, WhatIsDamagedIsRefusedWithItsLine) {
  EXPECT_THAT(marker_refusal(kNdiMarkers, "2,1,2,3,,,", "2,1,x2,3,,,"), HasSubstr("a.csv:4"));
  EXPECT_THAT(marker_refusal(kNdiMarkers, "2,1,2,3,,,", "2,1,2,3,4"), HasSubstr("a.csv:4: 5 cells, expected 7"));
  EXPECT_THAT(marker_refusal(kNdiMarkers, "2,1,2,3,,,", "1,1,2,3,,,"), HasSubstr("a.csv:4: frame 1 "));
  EXPECT_THAT(marker_refusal(kNdiMarkers, "100", "n/a"), HasSubstr("frame rate"));
  EXPECT_THAT(marker_refusal(kNdiMarkers, "cm", "kg"), HasSubstr("mm, cm"));
  EXPECT_THAT(marker_refusal(kViconMarkers, "P:B", "P:A"), HasSubstr("twice"));
}

TEST(MarkerTable, NamesAndColumnsThatDoNotGoTogetherAreRefused) {
  EXPECT_THAT(marker_refusal(kViconMarkers, ",,P:A,,,P:B,,", ",,P:A,,P:B,,"), HasSubstr("'P:B' stands"));
  EXPECT_THAT(marker_refusal(kViconMarkers, "X,Y,Z,X,Y,Z", "X,Y,Z,X,Y"), HasSubstr("column 8"));
  EXPECT_THAT(marker_refusal(kViconMarkers, "1,0,10,20,30,1,2,3", "1,0,10,7,20,30,1,2,3"),
              HasSubstr("9 cells, expected 8"));
  EXPECT_THAT(marker_refusal(kViconMarkers, "1,0,10,20,30,1,2,3", "1,0,10,0,20,0,30,0,1,0,2,0,3,0"),
              HasSubstr("decimal commas"));
  EXPECT_THAT(marker_refusal(kNdiMarkers, "M_2 z", "M_2 z,M_3 x"), HasSubstr("no table"));
}

TEST(MarkerTable, AMarkerWithoutANameLosesNeitherItselfNorTheOthers) {
  std::string text = kViconMarkers;
  text.replace(text.find("P:A"), 3, "");
  const MarkerFile file = parse_marker_table(text, "a.csv");
  EXPECT_THAT(file.markers.names, ElementsAre("marker_1", "B"));
  EXPECT_DOUBLE_EQ(file.markers.position(2, 1).z(), 0.006);
  EXPECT_THAT(file.repairs.back().message, HasSubstr("'marker_1'"));
}

TEST(MarkerTable, AMissingRowOfUnitsMakesNoUnitsOfSamples) {
  std::string text = kViconMarkers;
  const std::string units = ",,mm,mm,mm,mm,mm,mm\r\n";
  text.erase(text.find(units), units.size());
  const MarkerFile file = parse_marker_table(text, "a.csv");
  ASSERT_EQ(file.markers.frame_count(), 3);
  EXPECT_DOUBLE_EQ(file.markers.position(0, 0).x(), 0.01);
  EXPECT_THAT(file.repairs[0].message, HasSubstr("units"));
}

// Motive 1.24 writes a column of time codes, and a lost marker that it found again under its old name.
TEST(MarkerTable, PartsOfOneMarkerOfMotiveAreMarkers) {
  const std::string text =
      "Format Version,1.24,Take Name,t,Capture Frame Rate,120.000000,Length Units,Centimeters\n\n"
      ",Type,,Marker,Marker,Marker,Marker,Marker,Marker\n,Name,,Unlabeled 7,Unlabeled 7,Unlabeled 7,Unlabeled 7,"
      "Unlabeled 7,Unlabeled 7\n,ID,,A1,A1,A1,A2,A2,A2\n,,,Position,Position,Position,Position,Position,Position\n"
      "Frame,Time (Seconds),TimeCode,X,Y,Z,X,Y,Z\n0,0.000000,15:26:46:12.00,1,2,3,,,\n"
      "1,0.008333,15:26:46:12.01,,,,4,5,6\n";
  const MarkerFile file = parse_marker_table(text, "take.csv");
  EXPECT_THAT(file.markers.names, ElementsAre("Unlabeled 7", "Unlabeled 7_2"));
  EXPECT_TRUE(file.markers.missing(0, 1));
  EXPECT_DOUBLE_EQ(file.markers.position(1, 1).z(), 0.06);
}

TEST(MarkerTable, CountsOfTheHeaderAreComparedWithTheTable) {
  const auto said = [](const std::string& from, const std::string& to) {
    std::string text = kQualisysMarkers + "1\t2\t3\t4\t5\t6\n1\t2\t3\t4\t5\t6\n1\t2\t3\t4\t5\t6\n";
    text.replace(text.find(from), from.size(), to);
    std::string all;
    for (const Repair& r : parse_marker_table(text, "a.tsv").repairs) all += r.message + "\n";
    return all;
  };
  EXPECT_EQ(said("NO_OF_FRAMES\t3", "NO_OF_FRAMES\t3"), "");
  EXPECT_THAT(said("NO_OF_FRAMES\t3", "NO_OF_FRAMES\t5"), HasSubstr("5 rows"));
  EXPECT_THAT(said("NO_OF_MARKERS\t2", "NO_OF_MARKERS\t3"), HasSubstr("3 markers"));
}

TEST(ReadRecording, OfNexusTakesDevicesAndTrajectories) {
  const test::TemporaryFolder folder;
  write_file(folder / "a.csv", kViconMarkers);
  const Recording file = read_recording(folder / "a.csv");
  EXPECT_EQ(file.markers.marker_count(), 2);
  ASSERT_EQ(file.analog.channel_count(), 2);
  EXPECT_EQ(file.analog.channels()[0].name, "BIC");
  EXPECT_EQ(file.analog.channels()[0].unit, Unit::volt);
  EXPECT_NEAR(file.analog.series().mean_rate_hz(), 1000.0, 1e-6);
  EXPECT_EQ(file.analog.series().values()(2, 0), -0.1);
  EXPECT_EQ(read_markers(folder / "a.csv").markers.frame_count(), 3);
}

}  // namespace
}  // namespace myoid::recording
