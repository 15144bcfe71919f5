#include "myoid/recording/makers/channel_layouts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/makers/emg_table.h"
#include "myoid/recording/makers/marker_layouts.h"

namespace myoid::recording {
namespace {

using ::testing::HasSubstr;

/// Every one of these files holds BIC and TRI at 2000 Hz; the second sample is 0.003 and 0.004 V.
void expect_the_emg(const std::string& text) {
  const CsvSeries file = parse_emg_table(text, "a.txt");
  ASSERT_EQ(file.data.channel_count(), 2) << text;
  EXPECT_EQ(file.data.channels()[0].name, "BIC");
  EXPECT_EQ(file.data.channels()[1].name, "TRI");
  ASSERT_EQ(file.data.sample_count(), 3);
  EXPECT_NEAR(file.data.mean_rate_hz(), 2000.0, 0.01);
  EXPECT_NEAR(file.data.values()(1, 0), 0.003, 1e-15);
  EXPECT_NEAR(file.data.values()(1, 1), 0.004, 1e-15);
}

TEST(ChannelLayouts, BiopacsNamesAndUnitsInLinesOfTheirOwn) {
  const std::string head = "c:\\trial.acq\n0.5 msec/sample\n2 channels\nBIC\nmV\nTRI\nmV\n";
  expect_the_emg(head + "CH1\tCH2\t\n3\t3\t\n1\t2\t\n3\t4\t\n5\t6\t\n");
  expect_the_emg(head + "msec\tCH1\tCH2\n\t3\t3\n0\t1\t2\n0.5\t3\t4\n1\t5\t6\n");
  expect_the_emg(head + "min,CH1,CH2,\n,3,3,\n0,1,2,\n0.00000833,3,4,\n0.0000167,5,6,\n");
}

TEST(ChannelLayouts, QualisysChannelsWithoutAHeaderRow) {
  expect_the_emg(
      "NO_OF_SAMPLES\t3\nTOTAL_NO_OF_CHANNELS\t2\nFREQUENCY\t2000\nDESCRIPTION\t--\n"
      "DATA_INCLUDED\tANALOG\nCHANNEL_NAMES\tBIC\tTRI\nCHANNEL_GAIN\t1\t1\n"
      "0.001\t0.002\n0.003\t0.004\n0.005\t0.006\n");
}

// Qualisys writes speeds and angles that it derived with a frame and a time in every row, which the header names
// nowhere.
TEST(ChannelLayouts, ARowOfQualisysHasAFrameAndATimeBeforeTheNamedQuantities) {
  const std::string head = "NO_OF_FRAMES\t3\nNO_OF_DATA_TYPES\t2\nFREQUENCY\t200\nDATA_INCLUDED\tVelocity\n";
  const std::string names = "DATA_TYPES\tWrist_vel\tElbow_vel\n\n\n";
  for (const char* rows : {"1\t0.00000\t11.5\t12.5\n2\t0.00500\t21.5\t22.5\n3\t0.01000\t31.5\t32.5\n",
                           "0.00000\t11.5\t12.5\n0.00500\t21.5\t22.5\n0.01000\t31.5\t32.5\n",
                           "1\t11.5\t12.5\n2\t21.5\t22.5\n3\t31.5\t32.5\n", "11.5\t12.5\n21.5\t22.5\n31.5\t32.5\n"}) {
    const CsvSeries file = parse_emg_table(head + names + rows, "velocity.tsv");
    ASSERT_EQ(file.data.channel_count(), 2) << rows;
    EXPECT_EQ(file.data.channels()[0].name, "Wrist_vel");
    EXPECT_EQ(file.data.values()(1, 0), 21.5) << rows;
    EXPECT_EQ(file.data.values()(2, 1), 32.5) << rows;
    EXPECT_NEAR(file.data.time_s()[2] - file.data.time_s()[0], 0.01, 1e-15) << rows;
  }
  EXPECT_THROW((void)parse_emg_table(head + names + "1\t0\t3\t4\t5\n2\t0.005\t3\t4\t5\n", "v.tsv"), ReadError);
}

TEST(ChannelLayouts, ForcesOfQualisysWithARowOfNamesAlone) {
  const std::string text =
      "NO_OF_SAMPLES\t2\nFREQUENCY\t1200\nTIME_STAMP\t2026-01-01, 10:00:00\nFORCE_PLATE_NAME\tPlate 1\n"
      "FORCE_PLATE_LENGTH\t600\n\nForce_X\tForce_Z\tCOP_X\n1\t700\t10\n2\t701\t11\n";
  const CsvSeries file = parse_emg_table(text, "force.tsv");
  ASSERT_EQ(file.data.channel_count(), 3);
  EXPECT_EQ(file.data.channels()[1].name, "Force_Z");
  EXPECT_EQ(file.data.values()(1, 1), 701.0);
  EXPECT_NEAR(file.data.mean_rate_hz(), 1200.0, 1e-9);
}

TEST(ChannelLayouts, TracksOfBtsWithOneUnitForAll) {
  expect_the_emg(
      "BTS ASCII format\n\nType:\tEmg tracks\nMeasure unit:\tmV\n\nTracks:\t2\nFrequency:\t2000 "
      "Hz\n\nFrame\tTime\tBIC\tTRI\n1\t0.0000\t1\t2\n2\t0.0005\t3\t4\n3\t0.0010\t5\t6\n");
}

TEST(ChannelLayouts, DevicesOfNexusWithSubFrames) {
  expect_the_emg(
      "Devices\n2000\n,,EMG,\nFrame,Sub Frame,BIC,TRI\n,,mV,mV\n1,0,1,2\n1,1,3,4\n1,2,5,6\n\n"
      "Joints\n100\n");
}

TEST(ChannelLayouts, ChannelsOfOneNameAreToldApartByTheirDevice) {
  const CsvSeries file = parse_emg_table(
      "Devices\n1000\n,,Plate 1,,Plate 2,\nFrame,Sub Frame,Fx,Fz,Fx,Fz\n,,N,N,N,N\n1,0,1,2,3,4\n"
      "1,1,5,6,7,8\n1,2,5,6,7,8\n",
      "a.csv");
  EXPECT_EQ(file.data.channels()[2].name, "Plate 2 Fx");
  EXPECT_EQ(file.data.values()(1, 3), 8.0);
}

TEST(ChannelLayouts, ForcesOfBtsAreChannels) {
  const std::string text =
      "BTS ASCII format\n\nType:\tForce track\nMeasure unit:\tN\n\nTracks:\t3\nFrequency:\t500 Hz\n\n"
      "Frame\tTime\tFz1.X\tFz1.Y\tFz1.Z\n1\t0.000\t1\t2\t700\n2\t0.002\t3\t4\t701\n";
  EXPECT_FALSE(marker_layout(TableText(text), "f.emt"));
  const CsvSeries file = parse_emg_table(text, "f.emt");
  EXPECT_EQ(file.data.channels()[2], (Channel{"Fz1.Z", Unit::newton}));
  EXPECT_EQ(file.data.values()(1, 2), 701.0);
}

TEST(ChannelLayouts, JointsOfNexusAreRead) {
  const CsvSeries file = parse_emg_table(
      "Joints\n100\n,,S:LElbow,,\nFrame,Sub Frame,RX,RY,RZ\n,,deg,deg,deg\n1,0,90,1,2\n2,0,91,1,2\n", "j.csv");
  EXPECT_EQ(file.data.channels()[0], (Channel{"S:LElbow RX", Unit::radian}));
  EXPECT_NEAR(file.data.mean_rate_hz(), 100.0, 1e-9);
}

TEST(ChannelLayouts, SignalsOfVisual3dHaveTheirTimeOrAStatedRate) {
  const CsvSeries timed = parse_emg_table(
      "\ta.c3d\ta.c3d\ta.c3d\n\tTIME\tRElbow\tRElbow\n\tFRAME_NUMBERS\tLINK_MODEL_BASED\tLINK_MODEL_BASED\n"
      "\tORIGINAL\tORIGINAL\tORIGINAL\nITEM\tX\tX\tY\n1\t0\t7\t8\n2\t0.005\t9\t10\n",
      "v.txt");
  ASSERT_EQ(timed.data.channel_count(), 2);
  EXPECT_EQ(timed.data.channels()[1].name, "RElbow Y");
  EXPECT_EQ(timed.data.values()(1, 1), 10.0);
  EXPECT_EQ(timed.data.time_s()[1], 0.005);
  const std::string rows =
      "\tRElbow\tRElbow\n\tLINK_MODEL_BASED\tLINK_MODEL_BASED\n\tORIGINAL\tORIGINAL\nITEM\tX\tY\n"
      "1\t7\t8\n2\t9\t10\n";
  EXPECT_THROW((void)parse_emg_table("\ta.c3d\ta.c3d\n" + rows, "v.txt"), ReadError);
  EXPECT_THROW((void)parse_emg_table("Sampling rate: 200 Hz\n\ta.c3d\tb.c3d\n" + rows, "v.txt"), ReadError);
  const CsvSeries rated = parse_emg_table("Sampling rate: 200 Hz\n\ta.c3d\ta.c3d\n" + rows, "v.txt");
  EXPECT_EQ(rated.data.time_s()[1], 0.005);
  EXPECT_EQ(rated.data.values()(1, 0), 9.0);
}

TEST(ChannelLayouts, ATextOfSpike2IsRefusedInItsFirstLine) {
  try {
    (void)parse_emg_table("\"INFORMATION\"\n\"a.smr\"\n\n\"CHANNEL\"\t\"1\"\n\"START\"\t0\t0.001\n1\n2\n", "s.txt");
    ADD_FAILURE();
  } catch (const ReadError& error) {
    EXPECT_EQ(error.line(), 1U);
  }
}

TEST(EmgTable, ARowOfRatesBetweenNamesAndNumbersIsNoName) {
  const CsvSeries file = parse_emg_table(
      "Application:,Trigno Discover\n\nEMG 1 Time Series (s),EMG 1 (mV),ACC X 1 Time Series "
      "(s),ACC X 1 (G)\n2000.0 Hz,,500 Hz,\n0,1,0,0.5\n0.0005,2,0.002,0.5\n0.001,3,,\n",
      "a.csv");
  ASSERT_EQ(file.data.channel_count(), 1);
  EXPECT_EQ(file.data.channels()[0].name, "EMG 1");
  EXPECT_NEAR(file.data.values()(2, 0), 0.003, 1e-15);
  ASSERT_EQ(file.other_clocks.size(), 1U);
  EXPECT_EQ(file.other_clocks[0].data.sample_count(), 2);
}

TEST(EmgTable, NumbersWithoutNamesAreRefused) {
  try {
    (void)parse_emg_table("1.0,2.0,700.0\n1.0,2.0,701.0\n1.0,2.0,702.0\n", "amti.txt");
    FAIL() << "nothing thrown";
  } catch (const ReadError& error) {
    EXPECT_THAT(error.what(), HasSubstr("names"));
  }
}

}  // namespace
}  // namespace myoid::recording
