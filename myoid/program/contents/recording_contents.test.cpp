#include "myoid/program/contents/recording_contents.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/recording/c3d/c3d_writer.h"

#include "tests/support/plate_recording.h"
#include "tests/support/temporary_folder.h"

namespace myoid::program {
namespace {

TEST(RecordingContents, OfASeriesItTellsTimesUnitsExtremesAndGaps) {
  const test::TemporaryFolder folder;
  write_file(folder / "e.csv", "time,BIC [mV],TRI [mV]\n0,1,2\n0.01,-3,\n0.02,2,4\n");
  const auto contents = recording_contents(folder / "e.csv");
  ASSERT_TRUE(contents);
  EXPECT_EQ(contents->at("samples"), 3);
  EXPECT_NEAR(contents->at("rate_hz").get<double>(), 100.0, 1e-9);
  EXPECT_EQ(contents->at("channels").at(0).at("unit"), "V");
  EXPECT_NEAR(contents->at("channels").at(0).at("lowest").get<double>(), -0.003, 1e-12);
  EXPECT_EQ(contents->at("channels").at(1).at("gaps"), 1);
}

TEST(RecordingContents, ATableOfMarkersAloneIsToldByItsMarkersAndTheirGaps) {
  const test::TemporaryFolder folder;
  write_file(folder / "q.tsv",
             "NO_OF_FRAMES\t2\nNO_OF_CAMERAS\t8\nNO_OF_MARKERS\t2\nFREQUENCY\t100\n"
             "NO_OF_ANALOG\t0\nANALOG_FREQUENCY\t0\nDESCRIPTION\t--\n"
             "DATA_INCLUDED\t3D\nMARKER_NAMES\tA\tB\n"
             "1\t2\t3\t4\t5\t6\n0\t0\t0\t4\t5\t6\n");
  const auto contents = recording_contents(folder / "q.tsv");
  ASSERT_TRUE(contents);
  EXPECT_EQ(contents->at("kind"), "markers (.tsv)");
  EXPECT_EQ(contents->at("frames"), 2);
  EXPECT_NEAR(contents->at("rate_hz").get<double>(), 100.0, 1e-9);
  EXPECT_EQ(contents->at("markers").at(0).at("name"), "A");
  EXPECT_EQ(contents->at("markers").at(0).at("missing_frames"), 1);
  EXPECT_FALSE(contents->contains("channels"));
}

TEST(RecordingContents, TheUnitOfAnglesIsToldOfFilesThatMayHoldAngles) {
  const test::TemporaryFolder folder;
  const auto angles = [&](const char* title, const char* columns) {
    write_file(folder / "e.sto", std::string(title) + "\nnRows=2\nnColumns=3\ninDegrees=no\nendheader\ntime\t" +
                                     columns + "\n0.0\t1\t2\n0.1\t2\t3\n");
    return recording_contents(folder / "e.sto")->contains("angles");
  };
  EXPECT_TRUE(angles("Coordinates", "elbow_flexion\tpro_sup"));
  EXPECT_TRUE(angles("trial 3", "elbow_flexion\tforce"));
  EXPECT_FALSE(angles("Ground reaction", "ground_force_vx\tground_torque_y"));
  EXPECT_FALSE(angles("Inverse Dynamics Generalized Forces", "knee_angle_r_moment\tpelvis_tx_force"));
  EXPECT_FALSE(angles("raw surface EMG", "BIC\tTRI"));
}

TEST(RecordingContents, OneSampleHasAStartAndNoRate) {
  const test::TemporaryFolder folder;
  write_file(folder / "e.sto", "x\nnRows=1\nnColumns=2\nendheader\ntime\tBIC\n0.5\t2\n");
  write_file(folder / "m.trc",
             "PathFileType\t4\t(X/Y/Z)\tm.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n"
             "100\t100\t1\t1\tmm\nFrame#\tTime\tA\n\t\tX1\tY1\tZ1\n1\t0.5\t1\t2\t3\n");
  for (const char* name : {"e.sto", "m.trc"}) {
    const auto contents = recording_contents(folder / name);
    ASSERT_TRUE(contents) << name;
    EXPECT_EQ(contents->at("start_s"), 0.5) << name;
    EXPECT_EQ(contents->at("duration_s"), 0.0) << name;
    EXPECT_FALSE(contents->contains("rate_hz")) << name;
  }
}

// The laboratory of `PlateLoad` turned, with and without a screen's axis; without plates nothing tells.
TEST(RecordingContents, OfAC3dFileItTellsWhichWayIsUpAndWhatSaysSo) {
  const test::TemporaryFolder folder;
  for (const char up : {'x', 'y', 'z'}) {
    for (const bool screen : {false, true}) {
      test::PlateCase how{.R_LZ = test::laboratory_with_up(up)};
      if (screen) how.screen = std::string("+") + static_cast<char>(up - 32);
      recording::write_c3d(folder / "f.c3d", test::plate_recording(how));
      const auto contents = recording_contents(folder / "f.c3d");
      ASSERT_TRUE(contents);
      EXPECT_EQ(contents->at("up"), std::string(1, up));
      const auto from = contents->at("up_from").get<std::string>();
      EXPECT_EQ(from.find("SCREEN") != std::string::npos, screen) << from;
      EXPECT_NE(from.find("plate"), std::string::npos) << from;
    }
  }
  recording::C3dFile without = test::plate_recording(test::PlateCase{});
  without.groups.clear();
  recording::write_c3d(folder / "f.c3d", without);
  const auto contents = recording_contents(folder / "f.c3d");
  EXPECT_EQ(contents->at("up"), "not known");
  EXPECT_FALSE(contents->contains("up_from"));
}

TEST(RecordingContents, ATableWithoutAClockIsToldByItsColumnsAndWhyItIsNoRecording) {
  const test::TemporaryFolder folder;
  write_file(folder / "m.csv", "muscle,l0\nBIC,0.12\n");
  const auto contents = recording_contents(folder / "m.csv");
  ASSERT_TRUE(contents);
  EXPECT_EQ(contents->at("rows"), 1);
  EXPECT_EQ(contents->at("columns").at(1), "l0");
  EXPECT_TRUE(contents->contains("no_recording"));
}

TEST(RecordingContents, OfOtherNamesThereIsNothingAndAMissingFileIsAnError) {
  EXPECT_FALSE(recording_contents("arm.osim"));
  EXPECT_THROW((void)recording_contents("/nowhere/e.sto"), ReadError);
}

}  // namespace
}  // namespace myoid::program
